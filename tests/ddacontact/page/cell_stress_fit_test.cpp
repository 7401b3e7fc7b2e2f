#include "frames.hpp"

#include <ddacontact/output/cell_view.hpp>
#include <ddacontact/page/cell_stress_fit.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <gtest/gtest.h>

namespace {

using namespace ddacontact;

TEST(CellStressFit, IsExactForUniformStress) {
  Frame frame = support::empty_frame();
  Mat2 gradient;
  gradient << 1e-4, 2e-4, 0, -3e-4;
  support::add_block(frame, support::box(3, 4, 2, 1), gradient);
  const CellStressFit fit = fit_stress(frame, 0);
  const Vec3 stress = frame.mean_stress.col(0);
  EXPECT_LT((fit.at_centre - stress).norm(), 1e-9 * stress.norm());
  EXPECT_LT(fit.change_x.norm() + fit.change_y.norm(), 1e-9 * stress.norm());
}

TEST(CellStressFit, HasTheMeanStressAndTheBendingOfARectangle) {
  Frame frame = support::wall(1, 1);
  const CellStressFit fit = fit_stress(frame, 0);
  const CellView view(frame, 0);
  EXPECT_LT((fit.at_centre - view.mean_stress()).norm(), 1e-9 * view.mean_stress().norm());
  // Shape functions of a rectangle are bilinear, so xx changes linearly: the fit meets it at the corners.
  const Vec2 centre = view.corners().rowwise().mean();
  const double size = (view.corners().colwise() - centre).colwise().norm().maxCoeff();
  for (int k = 0; k < 4; ++k) {
    const Vec2 arm = (view.corners().col(k) - centre) / size;
    const Vec3 at_corner = fit.at_centre + arm.x() * fit.change_x + arm.y() * fit.change_y;
    polyfem::ShapeValues shape;
    view.basis()(view.corners(), view.corners().col(k), shape);
    EXPECT_LT((at_corner - view.stress(shape)).norm(), 1e-9 * at_corner.norm());
  }
}

TEST(CellStressFit, AveragesToTheMeanStressOverAnyPolygon) {
  Frame frame = support::empty_frame();
  Points outline(2, 5);
  outline << 0, 3, 4, 2, -1,  //
      0, 0, 1, 3, 1;
  support::add_block(frame, outline, Mat2::Zero());
  frame.strain_displacement = 1e-3 * Points::Random(2, 5);
  const CellStressFit fit = fit_stress(frame, 0);
  const CellView view(frame, 0);
  const Vec2 centre = outline.rowwise().mean();
  const double size = (outline.colwise() - centre).colwise().norm().maxCoeff();
  const Vec2 arm = (polyfem::area_moments(outline).centroid - centre) / size;
  const Vec3 mean = fit.at_centre + arm.x() * fit.change_x + arm.y() * fit.change_y;
  EXPECT_LT((mean - view.mean_stress()).norm(), 1e-9 * view.mean_stress().norm());
}

}  // namespace
