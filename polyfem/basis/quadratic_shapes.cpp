#include <polyfem/basis/quadratic_monomials.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/core/error.hpp>

#include <string>

namespace polyfem {
namespace {

/// Q^T = U R by Gram and Schmidt, twice: U is orthonormal to round-off then. Takes Q^T, leaves U.
Eigen::Matrix<double, 6, 6> orthonormalize(Monomials& U) {
  Eigen::Matrix<double, 6, 6> R = Eigen::Matrix<double, 6, 6>::Zero();
  for (Index k = 0; k < 6; ++k) {
    for (int pass = 0; pass < 2; ++pass)
      for (Index l = 0; l < k; ++l) {
        const double along = U.col(l).dot(U.col(k));
        U.col(k) -= along * U.col(l);
        R(l, k) += along;
      }
    R(k, k) = U.col(k).norm();
    U.col(k) /= R(k, k);
  }
  return R;
}

/// That of the nodes.
MonomialFrame frame_of(const PointsRef& nodes) {
  const Vec2 centre = nodes.rowwise().mean();
  Mat2 covariance = Mat2::Zero();
  for (const auto node : nodes.colwise()) covariance += (node - centre) * (node - centre).transpose();
  return {centre, covariance / static_cast<double>(nodes.cols())};
}

void require_midpoints(const PointsRef& cell) {
  const Index n = cell.cols();
  const double size = (cell.rowwise().maxCoeff() - cell.rowwise().minCoeff()).norm();
  const double round_off = 1e-10 * size + 1e-15 * cell.cwiseAbs().maxCoeff();
  for (Index k = 1; k < n; k += 2) {
    const Vec2 middle = (cell.col(k - 1) + cell.col((k + 1) % n)) / 2;
    if (!((cell.col(k) - middle).norm() <= round_off))
      throw Error("node " + std::to_string(k) +
                  " of a quadratic cell is not the middle of its edge: edges must be straight; make the mesh "
                  "by with_edge_midpoints after its corners are moved");
  }
}

/// M of the corners' functions, at their nodes.
void neighbour_products(const ShapeTable& corners, ShapeTable& table) {
  const Index n = corners.n_vertices(), n_points = corners.n_points();
  table.values.resize(n_points, 2 * n);
  table.dx.resize(n_points, 2 * n);
  table.dy.resize(n_points, 2 * n);
  for (Index i = 0; i < n; ++i) {
    const Index next = i + 1 < n ? i + 1 : 0, previous = i > 0 ? i - 1 : n - 1;
    const auto combine = [&](const MatrixXd& of) {
      return of.col(i).array() - of.col(previous).array() - of.col(next).array();
    };
    const auto own = corners.values.col(i).array(), neighbour = corners.values.col(next).array();
    const auto difference = combine(corners.values);
    table.values.col(2 * i) = own * difference;
    table.values.col(2 * i + 1) = 4 * own * neighbour;
    const auto differentiate = [&](const MatrixXd& slope, MatrixXd& result) {
      result.col(2 * i) = slope.col(i).array() * difference + own * combine(slope);
      result.col(2 * i + 1) = 4 * (slope.col(i).array() * neighbour + own * slope.col(next).array());
    };
    differentiate(corners.dx, table.dx);
    differentiate(corners.dy, table.dy);
  }
}

}  // namespace

Points quadratic_corners(const PointsRef& cell) {
  if (cell.cols() < 6 || cell.cols() % 2 != 0)
    throw Error("a quadratic cell of " + std::to_string(cell.cols()) +
                " nodes: give a corner and a midpoint in turn, as with_edge_midpoints does");
  return cell(Eigen::all, Eigen::seq(0, cell.cols() - 1, 2));
}

void evaluate_quadratic(const PointsRef& cell, const Basis& basis, const PointsRef& points,
                        ShapeTable& table) {
  const Points polygon = quadratic_corners(cell);
  require_midpoints(cell);
  thread_local ShapeTable corners;
  basis.evaluate(polygon, points, corners);
  neighbour_products(corners, table);

  // With Q^T = U R, the correction is U (R^-T p - U^T M).
  thread_local Monomials U, values, slopes, missing;
  const MonomialFrame frame = frame_of(cell);
  frame.evaluate(cell, U);
  const Eigen::Matrix<double, 6, 6> R = orthonormalize(U);
  const auto correct = [&](const Monomials& exact, MatrixXd& of) {
    missing = exact;
    for (Index k = 0; k < 6; ++k) {
      for (Index l = 0; l < k; ++l) missing.col(k) -= R(l, k) * missing.col(l);
      missing.col(k) /= R(k, k);
    }
    missing -= of.lazyProduct(U);
    of += missing.lazyProduct(U.transpose());
  };
  frame.evaluate(points, values);
  correct(values, table.values);
  frame.differentiate(values, 0, slopes);
  correct(slopes, table.dx);
  frame.differentiate(values, 1, slopes);
  correct(slopes, table.dy);
}

}  // namespace polyfem
