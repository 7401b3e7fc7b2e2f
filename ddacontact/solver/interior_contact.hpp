/// \file A contact in the interior-point method: its numbers, and how they follow displacements.
#pragma once

#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/solver/spring_state.hpp>
#include <ddacontact/solver/swept_law.hpp>

#include <cassert>

namespace ddacontact {

/// Two positive numbers whose product goes to mu.
struct InteriorPair {
  double x = 1, s = 1;
  double dx = 0, ds = 0;
  double target = 0;  ///< of the product

  void begin(double value, double mu) {
    assert(value > 0 && mu >= 0);
    x = value;
    s = mu / x;
  }
  void aim(double mu, double second_order) { target = mu - second_order * dx * ds; }
  void follow(double change) {
    assert(x > 0);
    dx = change;
    ds = (target - x * s - s * dx) / x;
  }
};

/// A contact inside its law. Changes of its forces by displacements follow from its own equations:
/// dN = w da + cN and dT = wt dq + mixed rate dN + cT.
struct InteriorContact {
  bool acts = false;  ///< the vertex meets the edge
  bool unilateral = true, sheared = false;
  bool holds = false;     ///< shear has no bound
  double tension = 0;     ///< of a bond; 0 where it is not unilateral
  double p = 0, p_t = 0;  ///< its stiffnesses
  double a = 0, q = 0, slip = 0;
  InteriorPair normal;  ///< N + tension and y; N alone where it is not unilateral
  double T = 0, dT = 0;
  InteriorPair upper, lower;  ///< u and f, v and k
  double b = 0, rate = 0;     ///< the bound of friction and its derivative by N
  double w = 0, wt = 0, mixed = 0, cN = 0, cT = 0;

  double N() const { return normal.x - tension; }
  bool slides() const { return sheared && !holds; }
  /// Errors of the equations of u and v.
  double upper_error() const { return upper.x - (b - T); }
  double lower_error() const { return lower.x - (b + T); }

  /// The state of the springs that is nearest.
  unsigned char state(const SweptLaw& law) const;

  /// Evaluates its equations at d; where it begins to act its products are mu.
  void evaluate(const ContactTerm& term, const SweptLaw& law, const VectorXd& d, double mu);
  /// Finds the rates at which its forces follow displacements.
  void find_rates();
  /// Sets the targets of the pairs in Newton's method.
  void aim(double mu, double second_order);
  /// The change of all numbers when displacements change the gap and the slip.
  void follow(double gap_change, double slip_change);
  /// Largest part of that change that keeps its numbers positive; 1: all of it.
  double longest();
  void advance(double length);

  template <class Visit>
  void for_pairs(Visit&& visit) {
    if (!acts) return;
    if (unilateral) visit(normal);
    if (!slides()) return;
    visit(upper);
    visit(lower);
  }

 private:
  void evaluate_friction(const SweptLaw& law);
  void begin(const ContactTerm& term, const SweptLaw& law, double mu);
};

}  // namespace ddacontact
