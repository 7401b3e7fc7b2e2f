/// \file Two polygons and the contacts found between them.
#pragma once

#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/half_width.hpp>
#include <ddacontact/detection/narrow_phase.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <vector>

namespace ddacontact {

/// Of outlines whose sides are computed for this alone.
inline std::vector<VertexEdge> contacts_between(Outline a, Outline b, const PairLimits& limits,
                                                std::span<const EarlierContact> earlier,
                                                std::span<const CoveredPart> covered = {}) {
  OutlineTable table(std::array{static_cast<int>(a.vertices.cols()), static_cast<int>(b.vertices.cols())});
  table.set(0, a.vertices);
  table.set(1, b.vertices);
  a.sides = table[0];
  b.sides = table[1];
  FoundContacts found;
  find_contacts(a, b, limits, earlier, covered, found);
  return found.contacts;
}

}  // namespace ddacontact

namespace support {

using ddacontact::coincidence;
using ddacontact::VertexEdge;

inline constexpr double lip = 1e-4;

inline Points box(double x, double y, double width, double height) {
  Points p(2, 4);
  p << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return p;
}

/// Two polygons, blocks 0 and 1.
struct PolygonPair {
  Points a, b;
  Vec2 motion_of_a = Vec2::Zero();  ///< predicted for the step; b stays where it is

  const Points& of(int block) const { return block == 0 ? a : b; }
  Vec2 vertex(const VertexEdge& c) const { return of(c.vertex_block).col(c.vertex); }
  Vec2 start(const VertexEdge& c) const { return of(c.edge_block).col(c.edge); }
  Vec2 end(const VertexEdge& c) const { return of(c.edge_block).col((c.edge + 1) % of(c.edge_block).cols()); }
  double gap(const VertexEdge& c) const {
    const Vec2 along = end(c) - start(c);
    return polyfem::cross(vertex(c) - start(c), along) / along.norm();
  }
  /// How far the vertex's projection lies within the edge, in m from the nearer end; < 0 outside.
  double inset(const VertexEdge& c) const {
    const Vec2 along = end(c) - start(c);
    const double s = along.dot(vertex(c) - start(c)) / along.norm();
    return std::min(s, along.norm() - s);
  }

  std::vector<VertexEdge> contacts(double search_margin, const std::vector<VertexEdge>& kept = {},
                                   bool swapped = false) const {
    const ddacontact::PairLimits limits{
        search_margin, std::min(ddacontact::half_width(a), ddacontact::half_width(b)), coincidence, lip};
    std::vector<ddacontact::EarlierContact> earlier;
    for (const VertexEdge& pair : kept) earlier.push_back({pair});
    const Points a_moved = a.colwise() + motion_of_a;
    const ddacontact::Outline of_a{0, a, a_moved}, of_b{1, b};
    return swapped ? ddacontact::contacts_between(of_b, of_a, limits, earlier)
                   : ddacontact::contacts_between(of_a, of_b, limits, earlier);
  }
  std::set<VertexEdge> contact_set(double search_margin, const std::vector<VertexEdge>& kept = {},
                                   bool swapped = false) const {
    const auto found = contacts(search_margin, kept, swapped);
    const std::set<VertexEdge> set(found.begin(), found.end());
    EXPECT_EQ(set.size(), found.size()) << "a contact was found twice";
    return set;
  }

  PolygonPair moved(double angle, const Vec2& by) const {
    const polyfem::Mat2 R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    return {(R * a).colwise() + by, (R * b).colwise() + by};
  }
  PolygonPair mirrored() const {
    const auto flip = [](const Points& p) -> Points {
      Points q = p.rowwise().reverse();
      q.row(0) *= -1;
      return q;
    };
    return {flip(a), flip(b)};
  }
  /// The polygons with their numbering started at other vertices.
  PolygonPair renumbered(int by_a, int by_b) const {
    const auto shift = [](const Points& p, int by) -> Points {
      Points q(2, p.cols());
      for (Index k = 0; k < p.cols(); ++k) q.col(k) = p.col((k + by) % p.cols());
      return q;
    };
    return {shift(a, by_a), shift(b, by_b)};
  }
};

}  // namespace support
