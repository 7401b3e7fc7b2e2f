/// \file One contact of a step: identity, law, history, and its gap and slip as affine forms.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/core/affine_form.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

namespace ddacontact {

/// What a contact carries from step to step.
struct ContactHistory {
  ContactState state = ContactState::open;
  double lock = 0;        ///< the lock point o as a fraction of the edge from j (0) to k (1)
  double gap_offset = 0;  ///< <= 0: the overlap it started with, taken as stress-free
  bool bonded = false;    ///< closed at the start and never slid or opened
  double length = 0;      ///< over which cohesion and tensile strength act, m
};

/// A vertex of one block against an edge of another, through one step.
struct Contact {
  VertexEdge pair;
  JointLaw law;
  ContactHistory history;  ///< at the start of the step, then at its end
  AffineForm gap, slip;    ///< (36) and (44) over the same unknowns; the gap without its offset
  double edge_length = 0;
  double length_tolerance = 0;  ///< gaps and slips below this are round-off, m
  double end_tolerance = 0;     ///< a vertex no further than this beyond an end of the edge is still on it, m
  // Results of the last accepted step.
  double end_gap = 0, end_slip = 0;
  double normal = 0;        ///< N, > 0 compression
  double shear = 0;         ///< force on the vertex along the edge from j to k
  bool was_closed = false;  ///< at the start, at the end or in between

  bool closed() const { return history.state != ContactState::open; }
  /// Whether the vertex projects onto the edge when its slip is this.
  bool is_on_edge(double at_slip) const {
    const double along = history.lock * edge_length + at_slip;
    return along >= -end_tolerance && along <= edge_length + end_tolerance;
  }
};

}  // namespace ddacontact
