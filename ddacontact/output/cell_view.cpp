#include <ddacontact/output/cell_view.hpp>

#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

namespace ddacontact {

namespace {

/// Corners that turn by less than this sine are of no use to Wachspress functions.
constexpr double least_turn = 1e-9;

}  // namespace

CellView::CellView(const Frame& frame, int cell)
    : frame_(frame),
      cell_(cell),
      corners_(2, frame.cells[cell].corners.count),
      basis_(frame.cells[cell].basis) {
  for (int k = 0; k < corners_.cols(); ++k) corners_.col(k) = frame.position.col(point(k));
  if (basis_ == &polyfem::wachspress && polyfem::find_non_convex_corner(local_corners(), least_turn))
    basis_ = &polyfem::mean_value;
}

Vec2 CellView::interpolate(const Points& of_points, const polyfem::ShapeValues& shape) const {
  Vec2 sum(0, 0);
  for (int k = 0; k < corners_.cols(); ++k) sum += shape.values[k] * of_points.col(point(k));
  return sum;
}

Vec3 CellView::stress_of(const Mat2& gradient) const {
  const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  return frame_.elasticity[cell().elasticity] * strain + frame_.stress_offset.col(cell_);
}

Vec3 CellView::stress(const polyfem::ShapeValues& shape) const {
  return stress_of(strain_displacement() * shape.gradients.transpose());
}

Vec3 CellView::mean_stress() const {
  const auto w = strain_displacement();
  const int count = cell().corners.count;
  Mat2 sum = Mat2::Zero();
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    const Vec2 edge = corners_.col(next) - corners_.col(k);
    sum += (w.col(k) + w.col(next)) / 2 * Vec2(edge.y(), -edge.x()).transpose();
  }
  return stress_of(sum / polyfem::signed_area(local_corners()));
}

}  // namespace ddacontact
