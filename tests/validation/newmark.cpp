/// \file Newmark's block on a shaken base.
#include "chapters.hpp"
#include "slider.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>

namespace validation {

namespace {

constexpr int n_cycles = 4;
constexpr double resting_time = 0.5;  ///< s, at the end
constexpr double time_steps[] = {0.01, 0.005, 0.002, 0.001, 5e-4};
constexpr double finest = time_steps[4];

/// The base has the acceleration a sin(2 pi f t) for some cycles, from rest to rest.
struct Shaking {
  double slope, friction;     ///< degrees
  double amplitude;           ///< a over g
  double frequency;           ///< f, Hz
  bool horizontally = false;  ///< else along the slope, upwards first

  double pulsation() const { return turn * frequency; }
  double shaken_until() const { return n_cycles / frequency; }
  double end() const { return std::round((shaken_until() + resting_time) / 0.01) * 0.01; }
  /// Down the slope and across it.
  Vec2 direction() const {
    const double a = radians(slope);
    return horizontally ? Vec2(-std::cos(a), -std::sin(a)) : Vec2(-1, 0);
  }
  /// Way of the base.
  double moved(double time) const {
    const double t = std::min(time, shaken_until()), w = pulsation();
    return amplitude * gravity / (w * w) * (w * t - std::sin(w * t));
  }
};

/// A rigid block on the base: its way relative to it, down the slope. In pieces, each of constant direction of slip, where
/// acceleration is a constant and a sine.
class RigidBlock {
 public:
  explicit RigidBlock(const Shaking& shaking) : shaking_(shaking), w_(shaking.pulsation()) {
    const double a = radians(shaking.slope), mu = std::tan(radians(shaking.friction));
    const Vec2 base = shaking.amplitude * gravity * shaking.direction();
    pull_ = {gravity * std::sin(a), -base.x()};
    grip_ = {mu * gravity * std::cos(a), mu * base.y()};
  }

  /// At `time`, from the start.
  double way(double time) {
    t_ = way_ = velocity_ = 0;
    slip_ = 0;
    while (t_ < time) advance(std::min(time, t_ + 1e-4));
    return way_;
  }

 private:
  /// constant + sine * sin(w t) while the base shakes.
  struct Wave {
    double constant = 0, sine = 0;
  };
  double at(const Wave& wave, double t) const {
    return wave.constant + (t < shaking_.shaken_until() ? wave.sine * std::sin(w_ * t) : 0);
  }
  Wave acceleration() const {
    return {pull_.constant - slip_ * grip_.constant, pull_.sine - slip_ * grip_.sine};
  }
  double velocity_at(double t) const {
    const Wave a = acceleration();
    const double until = shaking_.shaken_until(), from = std::min(t_, until), to = std::min(t, until);
    return velocity_ + a.constant * (t - t_) - a.sine / w_ * (std::cos(w_ * to) - std::cos(w_ * from));
  }
  double way_at(double t) const {
    const Wave a = acceleration();
    const double until = shaking_.shaken_until(), from = std::min(t_, until), to = std::min(t, until);
    const double at_end = velocity_ + a.sine / w_ * std::cos(w_ * from);
    return way_ + at_end * (t - t_) + a.constant * (t - t_) * (t - t_) / 2 -
           a.sine / (w_ * w_) * (std::sin(w_ * to) - std::sin(w_ * from)) -
           a.sine / w_ * std::cos(w_ * until) * std::max(0.0, t - std::max(t_, until));
  }
  /// Where `f` changes its sign between two times.
  template <class Function>
  static double root(double low, double high, const Function& f) {
    const bool rising = f(low) < 0;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((f(middle) < 0) == rising ? low : high) = middle;
    }
    return high;
  }
  void move_to(double t) {
    const double way = way_at(t), velocity = velocity_at(t);
    t_ = t;
    way_ = way;
    velocity_ = velocity;
  }
  void advance(double t) {
    if (slip_ == 0) {
      const auto spare = [&](double time) { return at(grip_, time) - std::abs(at(pull_, time)); };
      if (spare(t) >= 0) {
        t_ = t;
        return;
      }
      t_ = spare(t_) <= 0 ? t_ : root(t_, t, spare);
      slip_ = at(pull_, t) > 0 ? 1 : -1;
      return;
    }
    if (slip_ * velocity_at(t) >= 0) {
      move_to(t);
      return;
    }
    move_to(root(t_, t, [&](double time) { return velocity_at(time); }));
    velocity_ = 0;
    // It goes on at once the other way where it must.
    slip_ = at(grip_, t_) >= std::abs(at(pull_, t_)) ? 0 : at(pull_, t_) > 0 ? 1 : -1;
  }

  Shaking shaking_;
  double w_;
  Wave pull_, grip_;  ///< down the slope, and what friction bears
  double t_ = 0, way_ = 0, velocity_ = 0;
  int slip_ = 0;
};

}  // namespace

void newmark(Report& report) {
  report.heading("3. Newmark's block");
  for (Shaking sh : {Shaking{0,20,.6,2}, Shaking{0,20,.9,5}, Shaking{0,12,.9,3}, Shaking{18,28,.25,1.5}, Shaking{18,28,.4,4}, Shaking{18,28,.8,2}, Shaking{18,28,.25,1.5,true}, Shaking{18,28,.5,3,true}, Shaking{25,35,.6,2,true}}) {
    RigidBlock rigid(sh);
    double exact = rigid.way(sh.end());
    fmt::print("{} {} {} {} {}: exact {:.10f}", sh.slope, sh.friction, sh.amplitude, sh.frequency, sh.horizontally, exact);
    for (double dt : time_steps) {
      Slider s{.angle=radians(sh.slope), .friction=std::tan(radians(sh.friction)), .time_step=dt, .duration=sh.end()};
      Scene scene=slider_scene(s);
      scene.blocks[0].fixed=false;
      Support support; support.block=0; support.vertices={0,1,2,3};
      support.displacement.kind=TimeFunction::Kind::history;
      Vec2 dir = sh.direction().x()*s.down()+sh.direction().y()*s.up();
      for (double t=0;t<=sh.end()+finest/2;t+=finest) { Vec2 u=sh.moved(t)*dir; support.displacement.history.emplace_back(settling_time+t,u.x(),u.y()); }
      scene.supports={support};
      BuiltScene b=settled(scene);
      double x0=(travel(*b.stepper,1)-travel(*b.stepper,0)).dot(s.down());
      run(*b.stepper, scene.analysis.steps);
      double x=(travel(*b.stepper,1)-travel(*b.stepper,0)).dot(s.down())-x0;
      fmt::print(" {:.2e}", x/exact-1);
    }
    fmt::print("\n");
  }
}

}  // namespace validation
