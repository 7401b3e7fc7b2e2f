#include <ddacontact/detection/separation.hpp>

#include <algorithm>
#include <limits>

namespace ddacontact {

using polyfem::Index;
using polyfem::PointsRef;
using polyfem::Vec2;

namespace {

/// The largest gap over the edges of `a` between the edge's line and the nearest vertex of `b`.
double largest_edge_gap(const PointsRef& a, const PointsRef& b) {
  double largest = -std::numeric_limits<double>::infinity();
  for (Index j = 0; j < a.cols(); ++j) {
    const Vec2 origin = a.col(j);
    const Vec2 edge = a.col((j + 1) % a.cols()) - origin;
    const Vec2 normal = Vec2(edge.y(), -edge.x()) / edge.norm();
    double gap = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < b.cols(); ++i) gap = std::min(gap, normal.dot(b.col(i) - origin));
    largest = std::max(largest, gap);
  }
  return largest;
}

}  // namespace

double separation(const PointsRef& a, const PointsRef& b) {
  return std::max(largest_edge_gap(a, b), largest_edge_gap(b, a));
}

}  // namespace ddacontact
