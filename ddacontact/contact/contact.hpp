/// \file One contact of a step: identity, law, history, and its gap and slip as affine forms.
#pragma once

#include <ddacontact/contact/edge_motion.hpp>
#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/core/affine_form.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

namespace ddacontact {

/// What a contact carries from step to step.
struct ContactHistory {
  ContactState state = ContactState::open;
  double lock = 0;        ///< the lock point o as a fraction of the edge from j (0) to k (1)
  double gap_offset = 0;  ///< <= 0: the overlap it started with, taken as stress-free, as far as the blocks
                          ///< have not come apart since
  bool bonded = false;    ///< closed at the start and never slid or opened
  double length = 0;      ///< over which cohesion and tensile strength act, m
  double normal = 0;      ///< N at the end of the last step: where the staged method's multipliers start
  double shear = 0;       ///< T at the end of the last step
};

/// A vertex and an edge in motion: where they start, seen from the origin of the edge's block, and how the
/// unknowns move them.
struct MovingVertexEdge {
  VertexEdgePlace start;
  PointMap i, j, k;

  VertexEdgePlace at(const VectorXd& d) const { return {start.i + i(d), start.j + j(d), start.k + k(d)}; }
  VertexEdgePlace moved(const VectorXd& d) const { return {i(d), j(d), k(d)}; }
};

/// A contact between two steps: what the last one left and the next one carries on.
struct ContactRecord {
  VertexEdge pair;
  JointLaw law;
  ContactHistory history;  ///< at the start of the step, then at its end
  // Results of the last accepted step.
  double end_gap = 0, end_slip = 0;
  double normal = 0;        ///< N, > 0 compression
  double shear = 0;         ///< force on the vertex along the edge from j to k
  bool was_closed = false;  ///< at the start, at the end or in between
  bool augmented = false;   ///< its forces are multipliers: its springs store no energy

  bool closed() const { return history.state != ContactState::open; }
  /// Whether a bond of some strength holds it.
  bool has_bond() const { return history.bonded && (law.cohesion > 0 || law.tension > 0); }
  /// Whether the next step has to know of it: an open one has its overlap of the start still.
  bool lasts() const { return closed() || history.gap_offset < 0; }
};

/// A vertex of one block against an edge of another, through one step.
struct Contact : ContactRecord {
  MovingVertexEdge motion;
  AffineForm gap, slip;  ///< over the same unknowns; the gap without its offset. (36) and (44), or, in the
                         ///< staged method, the true ones at the end of the step with their derivatives
  double edge_length = 0;
  double straight_before = 0, straight_after = 0;  ///< how far the outline goes straight on at its ends, m
  double length_tolerance = 0;                     ///< gaps and slips below this are round-off, m
  double end_tolerance = 0;  ///< a vertex no further than this beyond an end of the edge is still on it, m
  double damping = 0;        ///< dashpot over the length of the step: force by change of the gap, N/m per m
  double size = 0;           ///< of the smaller block, held ones not counted, m

  /// Whether the vertex projects onto the edge, or what goes straight on from it, when its slip is this.
  bool is_on_edge(double at_slip) const {
    const double along = history.lock * edge_length + at_slip;
    return along >= -(end_tolerance + straight_before) &&
           along <= edge_length + straight_after + end_tolerance;
  }
};

/// What a try of a step changes of a contact and its results do not tell: as it was before.
struct ContactStart {
  ContactHistory history;
  double normal_stiffness = 0, tangential_stiffness = 0;
  double gap = 0, slip = 0;  ///< the gap without its offset

  ContactStart() = default;
  explicit ContactStart(const Contact& contact)
      : history(contact.history),
        normal_stiffness(contact.law.normal_stiffness),
        tangential_stiffness(contact.law.tangential_stiffness),
        gap(contact.gap.constant),
        slip(contact.slip.constant) {}
};

}  // namespace ddacontact
