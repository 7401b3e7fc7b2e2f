#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/core/error.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <string>

namespace polyfem {
namespace {

using Monomials = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Coordinates in which the nodes have mean 0 and covariance 1: monomials are as independent there on thin
/// cells as on round ones.
struct Frame {
  Vec2 centre;
  Mat2 scale;

  explicit Frame(const PointsRef& nodes) : centre(nodes.rowwise().mean()) {
    const Points arms = nodes.colwise() - centre;
    const Mat2 covariance = arms * arms.transpose() / static_cast<double>(nodes.cols());
    scale = covariance.llt().matrixL().solve(Mat2::Identity());
  }
};

/// 1, x, y, x^2, x y, y^2 in the frame, and their derivatives by the cell's own coordinates.
struct QuadraticPolynomials {
  Monomials values, dx, dy;

  QuadraticPolynomials(const Frame& frame, const PointsRef& points)
      : values(points.cols(), 6), dx(points.cols(), 6), dy(points.cols(), 6) {
    for (Index q = 0; q < points.cols(); ++q) {
      const Vec2 x = frame.scale * (points.col(q) - frame.centre);
      values.row(q) << 1, x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y();
      Eigen::Matrix<double, 2, 6> slopes;
      slopes << 0, 1, 0, 2 * x.x(), x.y(), 0,  //
          0, 0, 1, 0, x.x(), 2 * x.y();
      const Eigen::Matrix<double, 2, 6> by_cell = frame.scale.transpose() * slopes;
      dx.row(q) = by_cell.row(0);
      dy.row(q) = by_cell.row(1);
    }
  }
};

void require_midpoints(const PointsRef& cell) {
  const Index n = cell.cols();
  if (n < 6 || n % 2 != 0)
    throw Error("a quadratic cell of " + std::to_string(n) +
                " nodes: give a corner and a midpoint in turn, as with_edge_midpoints does");
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
    const auto combine = [&](const MatrixXd& of) { return of.col(i) - of.col(previous) - of.col(next); };
    const auto own = corners.values.col(i).array(), neighbour = corners.values.col(next).array();
    const Eigen::ArrayXd difference = combine(corners.values);
    table.values.col(2 * i) = own * difference;
    table.values.col(2 * i + 1) = 4 * own * neighbour;
    const auto differentiate = [&](const MatrixXd& slope, MatrixXd& result) {
      result.col(2 * i) = slope.col(i).array() * difference + own * combine(slope).array();
      result.col(2 * i + 1) = 4 * (slope.col(i).array() * neighbour + own * slope.col(next).array());
    };
    differentiate(corners.dx, table.dx);
    differentiate(corners.dy, table.dy);
  }
}

}  // namespace

Points quadratic_corners(const PointsRef& cell) {
  return cell(Eigen::all, Eigen::seq(0, cell.cols() - 1, 2));
}

void evaluate_quadratic(const PointsRef& cell, const Basis& basis, const PointsRef& points,
                        ShapeTable& table) {
  require_midpoints(cell);
  thread_local ShapeTable corners;
  basis.evaluate(quadratic_corners(cell), points, corners);
  neighbour_products(corners, table);

  // With Q^T = U R, the correction is U (R^-T p - U^T M).
  const Frame frame(cell);
  const Index n = cell.cols();
  const Eigen::HouseholderQR<Monomials> qr(QuadraticPolynomials(frame, cell).values);
  const Monomials U = qr.householderQ() * Monomials::Identity(n, 6);
  const Eigen::Matrix<double, 6, 6> R = qr.matrixQR().topRows<6>();
  const QuadraticPolynomials p(frame, points);
  const auto correct = [&](const Monomials& exact, MatrixXd& of) {
    const Monomials missing =
        R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(exact) - Monomials(of * U);
    of += missing * U.transpose();
  };
  correct(p.values, table.values);
  correct(p.dx, table.dx);
  correct(p.dy, table.dy);
}

}  // namespace polyfem
