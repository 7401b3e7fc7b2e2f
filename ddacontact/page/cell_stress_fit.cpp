#include <ddacontact/page/cell_stress_fit.hpp>

#include <ddacontact/output/cell_view.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <Eigen/LU>

namespace ddacontact {

namespace {

bool can_be_evaluated(const CellView& view) {
  return &view.basis() == &polyfem::wachspress || !polyfem::find_defect(view.local_corners());
}

}  // namespace

CellStressFit fit_stress(const Frame& frame, int cell) {
  const CellView view(frame, cell);
  CellStressFit fit;
  fit.at_centre = view.mean_stress();
  if (!fit.at_centre.allFinite()) fit.at_centre = frame.mean_stress.col(view.cell().block);
  if (!fit.at_centre.allFinite()) fit.at_centre.setZero();
  const Points& corners = view.corners();
  const Index n = corners.cols();
  if (n == 3 || !can_be_evaluated(view)) return fit;

  const Vec2 centre = corners.rowwise().mean();
  const Points arms = corners.colwise() - centre;
  const double size = arms.colwise().norm().maxCoeff();
  Mat2 moments = Mat2::Zero();
  Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
  polyfem::ShapeValues shape;
  for (Index k = 0; k < n; ++k) {
    const Vec2 arm = arms.col(k) / (2 * size);  // sums to zero over the corners
    view.basis()(corners, centre + size * arm, shape);
    moments += arm * arm.transpose();
    products += view.stress(shape) * arm.transpose();
  }
  const Eigen::Matrix<double, 3, 2> change = products * moments.inverse();
  if (!change.allFinite()) return fit;
  fit.change_x = change.col(0);
  fit.change_y = change.col(1);
  const Vec2 centroid = polyfem::area_moments(view.local_corners()).centroid + corners.col(0);
  const Vec3 at_centre = fit.at_centre - change * (centroid - centre) / size;
  if (at_centre.allFinite()) fit.at_centre = at_centre;
  return fit;
}

}  // namespace ddacontact
