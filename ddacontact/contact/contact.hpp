/// \file One contact of a step: identity, law, history, and how its vertex and edge move.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/contact/kinematics.hpp>
#include <ddacontact/contact/rounded_motion.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

namespace ddacontact {

/// History of a contact, carried from step to step.
struct ContactHistory {
  double lock = 0;  ///< the lock point o as a fraction of the edge from j (0) to k (1)
  /// The gap that counts as none, m. < 0: the overlap it started with, taken as stress-free, or what is left of
  /// a step that its corner has passed; > 0: one that glue or a block that came in has filled, what dilation has
  /// lifted, or the stress at the start has closed. Where a joint crushes either, as its force has moved.
  double gap_offset = 0;
  double length = 0;  ///< over which cohesion and tensile strength act, m
  double normal = 0;  ///< N at the end of the last step: where the multipliers start
  double shear = 0;   ///< T at the end of the last step
  /// The part of `length` on another joint, m: beyond the end of the edge, or, < 0, before its start. In
  /// single precision, which keeps contacts small.
  float length_beyond = 0;
  /// How often static corrections of its gap have been halved, since they changed nothing.
  std::uint8_t halvings = 0;
  ContactState state = ContactState::open;
  bool bonded = false;  ///< closed at the start and never slid or opened
};

/// The circle of a rounded corner in motion: it is tied to the segment from i to the vertex after it.
struct MovingRounding : Rounding {
  Vec2 start_after_i{0, 0};
  PointMap after_i{};
};

/// A vertex and an edge in motion: where they start, seen from the origin of the edge's block, and how the
/// unknowns move them.
struct MovingVertexEdge {
  VertexEdgePositions start;
  PointMap i, j, k;
  std::shared_ptr<const MovingRounding> rounding{};  ///< none: the corner is sharp

  RoundedPositions start_of_all() const { return {start, rounding ? rounding->start_after_i : Vec2::Zero()}; }
  void start_from(const RoundedPositions& positions) {
    start = positions;
    change_rounding([&](MovingRounding& of) { of.start_after_i = positions.after_i; });
  }
  /// Copies of this keep theirs.
  void change_rounding(const auto& change) {
    if (!rounding) return;
    auto changed = std::make_shared<MovingRounding>(*rounding);
    change(*changed);
    rounding = std::move(changed);
  }
  RoundedPositions moved(const VectorXd& d) const {
    return {{i(d), j(d), k(d)}, rounding ? rounding->after_i(d) : Vec2::Zero()};
  }
  /// Gap and slip after the motion `by` from these positions.
  GapAndSlip gap_and_slip_from(const RoundedPositions& positions, const RoundedPositions& by, double lock,
                               Directions directions) const {
    return rounding ? gap_and_slip(positions, by, lock, directions, *rounding)
                    : gap_and_slip(positions, by, lock, directions);
  }
  GapAndSlip gap_and_slip_at(const VectorXd& d, double lock, Directions directions) const {
    return gap_and_slip_from(start_of_all(), moved(d), lock, directions);
  }
  GapAndSlip rates_at(const RoundedPositions& positions, double lock) const {
    return gap_and_slip_from(positions, {{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()}, Vec2::Zero()}, lock,
                             Directions::of_end);
  }
  GapAndSlip rates_at_start(double lock) const { return rates_at(start_of_all(), lock); }
  double start_gap() const { return rounding ? rates_at_start(0).gap : gap(start); }
  /// The vertex whose position along the line j-k is the slip, with that line.
  VertexEdgePositions slip_positions() const {
    return rounding ? ddacontact::slip_positions(start_of_all(), *rounding) : start;
  }
  bool is_at_corner() const { return rounding && rounding->corner; }

  AffineForm form(const VertexEdgeGradient& gradient) const {
    AffineForm form = gradient_form(gradient, i, j, k);
    if (rounding) rounding->after_i.add_to(form, gradient.after_i);
    return form;
  }
  AffineForm form(const VertexEdgeForm& of_points) const {
    AffineForm of_unknowns = form(of_points.gradient);
    of_unknowns.constant = of_points.constant;
    return of_unknowns;
  }
  double change_along(const VertexEdgeGradient& gradient, const VectorXd& d) const {
    const double change = ddacontact::change_along(gradient, i, j, k, d);
    return rounding ? change + gradient.after_i.dot(rounding->after_i(d)) : change;
  }
  /// The affine form that has this value at d and this gradient: coefficients by way of the derivatives i, j,
  /// k of the positions by the unknowns. It returns the value to the rounding of its terms at d.
  AffineForm linear_form(double value, const VertexEdgeGradient& gradient, const VectorXd& d) const {
    AffineForm of_unknowns = form(gradient);
    of_unknowns.constant = value - of_unknowns.change(d);
    return of_unknowns;
  }
};

/// A contact between two steps: what the last one left and the next one carries on.
struct ContactRecord {
  VertexEdge pair;
  /// How far it has slipped since it was asked which way its corner goes, m; infinity: it was not asked.
  float since_asked = std::numeric_limits<float>::infinity();
  // Results of the last accepted step.
  double end_gap = 0, end_slip = 0;
  double normal = 0;  ///< N, > 0 compression
  double shear = 0;   ///< force on the vertex along the edge from j to k
  /// At the start of the step, then at its end. Flags stand where it would be padded.
  [[no_unique_address]] ContactHistory history;
  bool was_closed = false;  ///< at the start, at the end or in between

  bool closed() const { return history.state != ContactState::open; }
  /// Whether the next step has to know the contact: it is closed, or open with an overlap of the start or a
  /// rise by dilation.
  bool lasts() const { return closed() || history.gap_offset != 0; }
};

/// A vertex of one block against an edge of another, through one step.
struct Contact : ContactRecord {
  [[no_unique_address]] JointLaw law;  ///< flags stand where it would be padded
  bool start_bonded = false;  ///< `history.bonded` and `history.state` before a trial, which changes them
  ContactState start_state = ContactState::open;
  bool meets = false;   ///< over the edge where it passes its line within the step, or at the start
  bool leaves = false;  ///< goes round a corner at an end of the edge, and does not act in the step
  MovingVertexEdge motion;
  // At the end of the last trial of the step; before one, the gap at its start.
  double gap = 0;                          ///< without its offset
  double gap_change = 0, slip_change = 0;  ///< within the step
  /// Length of the collinear outline beyond its ends, m; < 0: of their arcs, which the edge is without.
  double straight_before = 0, straight_after = 0;
  double damping = 0;  ///< dashpot over the length of the step: force by change of the gap, N/m per m
  double size = 0;     ///< of the smaller block, held ones not counted, m

  /// Whether glue or a bond of some strength holds it.
  bool has_bond() const { return law.glued || (history.bonded && (law.cohesion > 0 || law.tension > 0)); }
  /// Force of the dashpot at a gap, N per m, > 0 when the gap has closed. It resists motion from the start of
  /// the step on, that of a joint with a stiffness from where the contact closes.
  double dashpot_force(double at_gap) const {
    const double from = law.compliant ? std::min(motion.start_gap(), history.gap_offset) : motion.start_gap();
    return -damping * (at_gap - from);
  }
  /// Length of the edge at the start of the step, m.
  double edge_length() const { return (motion.start.k - motion.start.j).norm(); }

  /// (36) and (44), the gap without its offset: of first order in displacements from the start.
  VertexEdgeForm first_gap() const {
    if (!motion.rounding) return gap_form(motion.start);
    const GapAndSlip rates = motion.rates_at_start(history.lock);
    return {rates.gap, rates.by_gap};
  }
  VertexEdgeForm first_slip() const {
    if (!motion.rounding) return slip_form(motion.start, history.lock);
    const GapAndSlip rates = motion.rates_at_start(history.lock);
    return {rates.slip, rates.by_slip};
  }

  /// Gaps and slips below this are round-off, m.
  double length_tolerance() const { return length_round_off * size; }
  /// A vertex no further than this beyond an end of the edge is still on it, m.
  double end_tolerance() const { return coincidence * size; }

  /// Whether the vertex projects onto the edge, or its collinear continuation, when its slip is this, or
  /// beyond it by no more than that.
  bool is_on_edge(double at_slip, double beyond) const {
    const double length = edge_length(), along = history.lock * length + at_slip;
    return along >= -(beyond + straight_before) && along <= length + straight_after + beyond;
  }
  bool is_on_edge(double at_slip) const { return is_on_edge(at_slip, end_tolerance()); }
  bool starts_on_edge() const { return is_on_edge(first_slip().constant); }
};

}  // namespace ddacontact
