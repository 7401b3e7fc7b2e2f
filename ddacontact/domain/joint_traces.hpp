/// \file The traces of a joint set in a part of the plane.
#pragma once

#include <ddacontact/domain/domain.hpp>

#include <polyfem/mesh/line_noding.hpp>

#include <cstdint>
#include <vector>

namespace ddacontact {

/// About how many traces of a set `joint_traces` would make.
double n_joint_traces(const JointSet& set, const PointsRef& place);

/// Traces that cover a polygon and reach beyond it; the same for the same seed. A drawn spacing or length is
/// at least a tenth of its mean, a drawn gap at least 0.
std::vector<polyfem::Segment> joint_traces(const JointSet& set, const PointsRef& place, std::uint64_t seed,
                                           int mark);

/// The parts of a segment inside a simple polygon.
std::vector<polyfem::Segment> parts_inside(const polyfem::Segment& segment, const PointsRef& polygon);

}  // namespace ddacontact
