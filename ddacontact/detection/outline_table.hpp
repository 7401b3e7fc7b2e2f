/// \file The sides of all outlines, computed once for all the pairs that they are compared in.
#pragma once

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/corner.hpp>

#include <span>
#include <vector>

namespace ddacontact {

/// Side from a vertex of an outline to the next.
struct Side {
  Vec2 tangent;
  double length;
  Corner corner;  ///< at the vertex where it starts

  Vec2 along() const { return length * tangent; }
  Vec2 normal() const { return {tangent.y(), -tangent.x()}; }  ///< outward of a counter-clockwise polygon
};

/// Sides and box of an outline, and whether it is concave.
struct OutlineSides {
  std::span<const Side> sides;
  Box box;
  bool concave;  ///< the outline turns right at some vertex, however little
};

/// Simple, counter-clockwise polygons, by their numbers.
class OutlineTable {
 public:
  /// \param[in] n_vertices  of each polygon
  explicit OutlineTable(std::span<const int> n_vertices = {});

  /// The present positions of a polygon's vertices, relative to any origin. Different polygons may be set
  /// at the same time.
  void set(int polygon, const PointsRef& vertices);

  /// Sides of a polygon; the box is relative to the origin of its vertices.
  OutlineSides operator[](int polygon) const {
    const int first = first_[polygon];
    return {{sides_.data() + first, static_cast<std::size_t>(first_[polygon + 1] - first)},
            boxes_[polygon],
            concave_[polygon] != 0};
  }

 private:
  std::vector<int> first_{0};  ///< of each polygon, in sides_
  std::vector<Side> sides_;
  std::vector<Box> boxes_;
  std::vector<char> concave_;
};

}  // namespace ddacontact
