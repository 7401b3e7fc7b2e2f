/// \file Which segments pass near a point.
#pragma once

#include <polyfem/mesh/line_noding.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// Squares of equal size, each with the segments that pass through it.
class SegmentGrid {
 public:
  /// \param[in] n_squares  about as many squares, at least 1, over the box of all segments
  SegmentGrid(const std::vector<Segment>& segments, double n_squares);

  /// In rising order. Every segment is among them that passes the point by less than a millionth of a square.
  std::span<const int> near(const Vec2& point) const;

 private:
  int column(double x) const;
  int row(double y) const;
  /// Calls visit(square) for each square that the segment passes through.
  template <class Visit>
  void walk(const Segment& segment, Visit&& visit) const;

  Vec2 low_;
  double size_ = 1;
  int n_columns_ = 1, n_rows_ = 1;
  std::vector<int> first_, segments_;  ///< square s has segments_[first_[s]] up to first_[s + 1]
};

}  // namespace polyfem
