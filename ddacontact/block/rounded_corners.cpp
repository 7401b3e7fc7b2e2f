#include <ddacontact/block/rounded_corners.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// From a vertex to where a circle of radius 1 touches its edges: the tangent of half the angle that the
/// outline turns by, 0 where it turns right.
double cut_of_unit_circle(const PointsRef& outline, Index vertex) {
  const Index n = outline.cols(), before = (vertex + n - 1) % n, after = (vertex + 1) % n;
  const Vec2 in = outline.col(vertex) - outline.col(before), out = outline.col(after) - outline.col(vertex);
  return std::max(0.0, std::tan(std::atan2(cross(in, out), in.dot(out)) / 2));
}

double edge_length(const PointsRef& outline, Index edge) {
  return (outline.col((edge + 1) % outline.cols()) - outline.col(edge)).norm();
}

}  // namespace

RoundedBlock round_corners(const PointsRef& outline, double radius) {
  RoundedBlock rounded{radius, {}};
  for (Index v = 0; v < outline.cols(); ++v) {
    const double cut = radius * cut_of_unit_circle(outline, v), length = edge_length(outline, v);
    rounded.corners.push_back({{cut / length, radius / length}, cut > 0});
  }
  return rounded;
}

LargestRounding largest_rounding(const PointsRef& outline) {
  LargestRounding largest{inf, 0};
  for (Index e = 0; e < outline.cols(); ++e) {
    const double cuts =
        cut_of_unit_circle(outline, e) + cut_of_unit_circle(outline, (e + 1) % outline.cols());
    if (cuts * largest.radius > edge_length(outline, e))
      largest = {edge_length(outline, e) / cuts, static_cast<int>(e)};
  }
  return largest;
}

}  // namespace ddacontact
