/// \file Joints with a strength in compression: forces N act N / (2 strength) away from the corners.
#include "../simple_scenes.hpp"

#include <ddacontact/output/run_verdict.hpp>
#include <ddacontact/scene/reader.hpp>

#include <Eigen/LU>

#include <random>

using namespace support;

namespace {

Scene masonry(double strength) {
  Scene scene = rock_scene(0.01, 100);
  scene.analysis.mode = Mode::statics;
  scene = default_mechanics(scene);
  scene.analysis.max_displacement_ratio = 0.1;
  scene.materials[0].young = 2e12;
  scene.joints[0].friction_angle = 60;
  scene.joints[0].compressive_strength = strength;
  return scene;
}

/// 40 kN, 1 m wide and 2 m high, pushed at its top.
Scene wall(double strength, double push) {
  Scene scene = masonry(strength);
  scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 2))};
  scene.loads = {point_load(1, Vec2(0, 2), constant({push, 0}))};
  scene.loads[0].force.rise = 0.2;
  return scene;
}

/// Two stones of 100 kN, 5 m long and 1 m high, between abutments: a moment of 250 kN m in the middle.
Scene voussoir_beam(double strength) {
  Scene scene = masonry(strength);
  scene.blocks = {block(rectangle(-2, -1, 2, 3), true), block(rectangle(10, -1, 2, 3), true),
                  block(rectangle(0, 0, 5, 1)), block(rectangle(5, 0, 5, 1))};
  return scene;
}

bool stands(const Scene& scene) {
  BuiltScene built = build(scene);
  for (int k = 0; k < scene.n_steps(); ++k)
    if (!built.stepper->step()) return false;
  return built.stepper->is_at_rest() &&
         travel(*built.stepper, scene.blocks.size() == 2 ? 1 : 2).norm() < 0.05;
}

/// The forces of a joint in x.
double thrust(const Stepper& stepper, int a, int b) {
  double sum = 0;
  for (const ddacontact::ContactRecord& contact : stepper.contacts())
    if (std::minmax(contact.pair.vertex_block, contact.pair.edge_block) == std::minmax(a, b))
      sum += contact.normal;
  return sum;
}

/// The largest load on the arch of examples/arch_quarter_load.toml by the static theorem: thrusts with
/// |M| <= N (b / 2 - N / (2 strength)) and |V| <= N tan(phi) in every joint, a concave program of the force
/// and the moment at one springing and the load, solved by a barrier. Units are 100 kN and m.
class ArchLimit {
 public:
  ArchLimit(double strength, double friction) : strength_(strength), friction_(friction) {
    const double angle = std::numbers::pi / n, inner = 4, outer = 4.8;
    const auto at = [&](double radius, int k) {
      return Vec2(radius * std::cos(k * angle), radius * std::sin(k * angle));
    };
    Eigen::Matrix<double, 3, 5> before = Eigen::Matrix<double, 3, 5>::Identity();
    before.col(4).setZero();
    for (int k = 0; k <= n; ++k) {
      const Vec2 outward = at(1, k), along(-outward.y(), outward.x()), middle = at((inner + outer) / 2, k);
      add_joint(outward.transpose() * before.topRows(2), along.transpose() * before.topRows(2),
                before.row(2) - middle.x() * before.row(1) + middle.y() * before.row(0), outer - inner);
      Points voussoir(2, 4);
      voussoir << at(inner, k), at(outer, k), at(outer, k + 1), at(inner, k + 1);
      const polyfem::AreaMoments moments = polyfem::area_moments(voussoir);
      const double weight = 2000 * 9.8 * moments.area / 1e5;
      before(1, 4) -= weight;
      before(2, 4) -= weight * moments.centroid.x();
      if (k != loaded) continue;
      before(1, 3) -= 1;
      before(2, 3) += 2.2;
    }
  }

  double largest_load() const {
    Vec4 z = any_admissible();
    for (double weight = 1e-2; weight > 1e-8; weight /= 2)
      for (int round = 0; round < 30; ++round) z = newton(z, weight);
    return z[3] * 1e5;
  }

 private:
  using Vec4 = Eigen::Vector4d;
  using Row = Eigen::Matrix<double, 1, 5>;
  static constexpr int n = 13, loaded = 8;

  /// linear . z + constant - square (thrust . z + thrust[4])^2 >= 0
  struct Bound {
    Row linear, thrust;
    double square;

    static double of(const Row& row, const Vec4& z) { return row.head<4>() * z + row[4]; }
    double left(const Vec4& z) const { return of(linear, z) - square * std::pow(of(thrust, z), 2); }
    Vec4 gradient(const Vec4& z) const {
      return (linear - 2 * square * of(thrust, z) * thrust).head<4>().transpose();
    }
  };

  void add_joint(const Row& shear, const Row& thrust, const Row& moment, double length) {
    for (const double sign : {1.0, -1.0}) {
      bounds_.push_back({length / 2 * thrust - sign * moment, thrust, 1e5 / (2 * strength_)});
      bounds_.push_back({friction_ * thrust - sign * shear, thrust, 0});
    }
  }
  bool is_admissible(const Vec4& z) const {
    return std::ranges::all_of(bounds_, [&](const Bound& bound) { return bound.left(z) > 0; });
  }
  Vec4 any_admissible() const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    while (true) {
      const double across = -2 * part(random), up = 3 * part(random);
      if (const Vec4 z(across, up, (4 + 0.8 * part(random)) * up, 0.01); is_admissible(z)) return z;
    }
  }
  Vec4 newton(const Vec4& z, double weight) const {
    Vec4 gradient(0, 0, 0, 1);
    Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
    for (const Bound& bound : bounds_) {
      const Vec4 slope = bound.gradient(z) / bound.left(z), thrust = bound.thrust.head<4>().transpose();
      gradient += weight * slope;
      hessian -= weight *
                 (slope * slope.transpose() + 2 * bound.square / bound.left(z) * thrust * thrust.transpose());
    }
    Vec4 step = -hessian.inverse() * gradient;
    const double decrement = std::sqrt(std::max(0.0, gradient.dot(step) / weight));
    step /= 1 + decrement;
    while (!is_admissible(z + step)) step /= 2;
    return z + step;
  }

  double strength_, friction_;
  std::vector<Bound> bounds_;
};

}  // namespace

/// M = N (b / 2 - N / (2 strength)).
TEST(Crushing, LowersTheMomentThatAWallBears) {
  for (const double strength : {1e6, 2e5, 8e4}) {
    const double most = 40e3 * (0.5 - 40e3 / (2 * strength)) / 2;
    EXPECT_TRUE(stands(wall(strength, 0.99 * most))) << strength;
    EXPECT_FALSE(stands(wall(strength, 1.01 * most))) << strength;
  }
}

/// H (1 m - H / strength) = 250 kN m has a root down to a strength of 1 MPa.
TEST(Crushing, BringsAVoussoirBeamDown) {
  for (const double strength : {1e9, 4e6, 2e6, 1.2e6}) {
    const BuiltScene built = run(voussoir_beam(strength));
    const double H = strength / 2 * (1 - std::sqrt(1 - 1e6 / strength));
    EXPECT_NEAR(thrust(*built.stepper, 2, 3), H, 1e-3 * H) << strength;
    EXPECT_TRUE(built.stepper->is_at_rest());
  }
  EXPECT_TRUE(stands(voussoir_beam(1.02e6)));
  EXPECT_FALSE(stands(voussoir_beam(0.98e6)));
}

TEST(Crushing, LowersTheLoadOfAnArchAsInLimitAnalysis) {
  const double friction = std::tan(radians(35));
  EXPECT_NEAR(ArchLimit(1e12, friction).largest_load(), 85.30e3, 0.02e3);
  for (const double strength : {4e6, 2e6, 1e6}) {
    const double limit = ArchLimit(strength, friction).largest_load();
    const auto loaded = [&](double part) {
      const SceneReading reading = read_scene(EXAMPLES "/arch_quarter_load.toml",
                                              {"joint.0.compressive_strength=" + std::to_string(strength),
                                               "parameters.load=" + std::to_string(-part * limit)});
      EXPECT_TRUE(reading.scene);
      BuiltScene built = build(*reading.scene);
      while (!built.stepper->is_at_rest() && built.stepper->counts().steps < 200)
        if (!built.stepper->step()) return false;
      return built.stepper->is_at_rest();
    };
    EXPECT_LT(limit, 85e3);
    EXPECT_TRUE(loaded(0.98)) << strength << ": " << limit;
    EXPECT_FALSE(loaded(1.02)) << strength << ": " << limit;
  }
}

/// The reference turns as a rigid body about where N = W acts.
TEST(Crushing, OverturnsAWallInDynamicStepsOfAnyLength) {
  const double width = 0.5, height = 2, strength = 2e5, mass = 2000 * width * height, weight = 10 * mass,
               arm = width / 2 - weight / (2 * strength), rise = 0.5, end = 2;
  const auto by_hand = [&](double push) {
    const double inertia = mass * ((width * width + height * height) / 12 + arm * arm + height * height / 4);
    double tilt = 0, rate = 0;
    constexpr double dt = 1e-4;
    for (double t = 0; t < end; t += dt) {
      const double up = std::cos(tilt) * height / 2 + std::sin(tilt) * arm,
                   back = std::cos(tilt) * arm - std::sin(tilt) * height / 2,
                   moment = push * std::min(t / rise, 1.0) * up - weight * back;
      if (tilt > 0 || moment > 0) rate += dt * moment / inertia;
      tilt += dt * rate;
    }
    return tilt;
  };
  const auto tilt = [&](double push, double time_step) {
    Scene scene = masonry(strength);
    scene.materials[0].young = 3e10;
    scene.blocks = {block(rectangle(-20, -1, 40, 1), true), block(rectangle(0, 0, width, height))};
    scene.loads = {point_load(1, Vec2(width / 2, height / 2), constant({push, 0}))};
    scene.loads[0].force.rise = rise;
    scene.analysis.mode = Mode::dynamic;
    scene.analysis.time_step = time_step;
    scene.analysis.steps = static_cast<int>(std::lround(end / time_step));
    const BuiltScene built = run(scene);
    return -built.stepper->state().rotation[1];
  };
  const double most = weight * arm / (height / 2);
  for (const double time_step : {0.01, 0.002}) {
    EXPECT_LT(tilt(0.95 * most, time_step), 1e-3) << time_step;
    EXPECT_NEAR(tilt(1.16 * most, time_step) / by_hand(1.16 * most), 1, 0.1) << time_step;
  }
}

TEST(Crushing, OfAWholeJointIsWarnedOf) {
  const auto warnings = [](double strength) {
    Scene scene = wall(strength, 0);
    scene.analysis.steps = 5;
    return std::ranges::count_if(ddacontact::warnings_of(*run(scene).stepper), [](const std::string& text) {
      return text.find("compressive_strength") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings(41e3), 0);
  EXPECT_EQ(warnings(39e3), 1);
}
