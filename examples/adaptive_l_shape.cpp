// Cells refined where the error is: a potential with a corner that bends inwards.
//
//        laplace u = 0 in an L-shaped domain,    u = r^(2/3) sin(2/3 theta) on its boundary,
//
// which is the solution. Its gradient is infinite in the corner, so equal cells of size h have the energy
// error h^(2/3), N^(-1/3) of N unknowns. Dividing the cells with the largest errors keeps N^(-1/2). The error
// of a cell is estimated by what its gradient differs from the one that is averaged around vertices
// (Zienkiewicz and Zhu 1987). A divided cell leaves vertices on the sides of its neighbours: polygons take
// them as they are, no neighbour has to follow.
#include <polyfem/polyfem.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <numeric>

using namespace polyfem;

/// The angle clockwise from the side below the corner, 0 to 3 pi / 2.
double angle(const Vec2& x) {
  const double from_below = std::atan2(-x.x(), -x.y());
  return from_below < -1e-12 ? from_below + 2 * std::numbers::pi : std::max(0., from_below);
}
double exact(const Vec2& x) {
  return std::pow(x.norm(), 2. / 3) * std::sin(angle(x) * 2 / 3);
}
Vec2 exact_gradient(const Vec2& x) {
  const double r = x.norm(), a = angle(x), size = 2. / 3 * std::pow(r, -1. / 3);
  const Vec2 outwards = x / r, around(outwards.y(), -outwards.x());
  return size * (std::sin(a * 2 / 3) * outwards + std::cos(a * 2 / 3) * around);
}

TabulatedElement tabulated(const PointsRef& cell) {
  TabulatedElement element;
  tabulate(cell, element);
  return element;
}

/// Energy errors, squared.
struct Errors {
  VectorXd estimated;  ///< of each cell
  double exact = 0;    ///< of all
};

Errors solve(const PolygonMesh& mesh, int& n_unknowns) {
  FieldProblem problem(mesh, 1);
  problem.assemble([](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    diffusion(tabulated(cell), Mat2::Identity(), K);
  });
  for (const int v : boundary_vertices(mesh)) problem.hold(v, 0, exact(mesh.vertices.col(v)));
  problem.solve();
  n_unknowns = problem.n_unknowns();

  MatrixXd at_corners(2, static_cast<Index>(mesh.indices.size())), of_cell;
  std::vector<MatrixXd> gradients;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    const TabulatedElement element = tabulated(cell);
    const VectorXd u = problem.cell_solution(c);
    MatrixXd& gradient = gradients.emplace_back(2, element.rule.weights.size());
    gradient << (element.dx * u).transpose(), (element.dy * u).transpose();
    extrapolate_to_vertices(cell, element, gradient, of_cell);
    at_corners.middleCols(mesh.offsets[static_cast<std::size_t>(c)], cell.cols()) = of_cell;
  }
  const MatrixXd averaged = vertex_averages(mesh, at_corners);
  Errors errors{VectorXd::Zero(mesh.n_cells()), 0};
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const TabulatedElement element = tabulated(mesh.outline(c));
    const std::span<const int> corners = mesh.cell(c);
    const MatrixXd around = averaged(Eigen::all, std::vector<int>(corners.begin(), corners.end()));
    const MatrixXd& gradient = gradients[static_cast<std::size_t>(c)];
    for (Index q = 0; q < element.rule.weights.size(); ++q) {
      const double weight = element.rule.weights[q];
      const Vec2 recovered = around * element.values.row(q).transpose();
      errors.estimated[c] += weight * (gradient.col(q) - recovered).squaredNorm();
      errors.exact += weight * (gradient.col(q) - exact_gradient(element.rule.points.col(q))).squaredNorm();
    }
  }
  return errors;
}

/// Those with the largest errors that make up half of the whole (Doerfler 1996).
std::vector<char> mark(const VectorXd& errors) {
  std::vector<int> order(static_cast<std::size_t>(errors.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](int c) { return errors[c]; });
  std::vector<char> marked(order.size(), 0);
  double sum = 0;
  for (const int c : order) {
    if (sum >= errors.sum() / 2) break;
    marked[static_cast<std::size_t>(c)] = 1;
    sum += errors[c];
  }
  return marked;
}

/// The power of the unknowns that the error falls with, over the last three quarters of the meshes.
double rate(bool everywhere, PolygonMesh mesh, int most_unknowns) {
  std::cout << (everywhere ? "all cells divided\n" : "those with the largest errors divided\n")
            << "unknowns   error       estimated / exact\n";
  std::vector<double> unknowns, error;
  for (int n = 0;;) {
    const Errors errors = solve(mesh, n);
    unknowns.push_back(std::log(n));
    error.push_back(std::log(errors.exact) / 2);
    std::cout << n << "    " << std::sqrt(errors.exact) << "    "
              << std::sqrt(errors.estimated.sum() / errors.exact) << '\n';
    if (n > most_unknowns) break;
    mesh = divide_cells(mesh, everywhere ? std::vector<char>(static_cast<std::size_t>(mesh.n_cells()), 1)
                                         : mark(errors.estimated));
  }
  const std::size_t first = unknowns.size() / 4;
  return -(error.back() - error[first]) / (unknowns.back() - unknowns[first]);
}

/// Squares on three quarters of a square.
PolygonMesh l_shape() {
  const PolygonMesh square = rectangles({-1, -1}, {1, 1}, 6, 6);
  PolygonMesh mesh;
  std::vector<int> number(static_cast<std::size_t>(square.vertices.cols()), -1);
  std::vector<int> kept;
  for (int c = 0; c < square.n_cells(); ++c) {
    const Vec2 middle = square.outline(c).rowwise().mean();
    if (middle.x() > 0 && middle.y() < 0) continue;
    for (const int v : square.cell(c)) {
      int& of_vertex = number[static_cast<std::size_t>(v)];
      if (of_vertex < 0) {
        of_vertex = static_cast<int>(kept.size());
        kept.push_back(v);
      }
      mesh.indices.push_back(of_vertex);
    }
    mesh.offsets.push_back(static_cast<int>(mesh.indices.size()));
  }
  mesh.vertices = square.vertices(Eigen::all, kept);
  return mesh;
}

int main() {
  const PolygonMesh mesh = l_shape();
  const double uniform = rate(true, mesh, 10000), adaptive = rate(false, mesh, 5000);
  std::cout << "the error falls with the power " << uniform << " of the unknowns, and " << adaptive
            << " where cells are chosen\n";
  return std::abs(uniform - 1. / 3) < 0.03 && std::abs(adaptive - 0.5) < 0.05 ? EXIT_SUCCESS : EXIT_FAILURE;
}
