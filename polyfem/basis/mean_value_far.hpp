/// \file Mean value functions by plain arithmetic, at points where nothing large cancels in it.
#pragma once

#include <polyfem/basis/basis.hpp>
#include <polyfem/basis/lanes.hpp>

#include <vector>

namespace polyfem {

/// Mean value functions at points that are far from all vertices and edges of a polygon without short edges.
/// It takes a third of the operations of the formulas that are good at any point.
class MeanValueFarFromBoundary {
 public:
  /// False: there are short edges; no point is far then.
  bool set(const PointsRef& polygon);

  /// N and grad N to 1e-14 (gradients relative to the largest one) of the lanes that it returns, in rows from
  /// `row` on; other lanes get what is of no use.
  LaneMask evaluate(const LaneVector& x, Index row, ShapeTable& table);

 private:
  /// Vertex i and the edge to the next.
  struct Corner {
    Same x, y, edge_x, edge_y;
  };
  /// Vertex i as the points see it.
  struct Vertex {
    LaneVector d;           ///< v_i - x
    Lanes rho, inverse;     ///< |d| and 1 / |d|
    LaneVector per_square;  ///< d / |d|^2, turned right the gradient of its direction
  };
  /// w_i and its gradient.
  struct Weight {
    Lanes w;
    LaneVector gradient;
  };

  double largest_inverse_ = 0;  ///< of distances from vertices that are far
  std::vector<Corner> corners_;
  std::vector<Vertex> vertices_;
  std::vector<Weight> weights_;
};

}  // namespace polyfem
