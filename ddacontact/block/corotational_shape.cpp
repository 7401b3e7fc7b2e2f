#include <ddacontact/block/corotational_shape.hpp>

#include <ddacontact/block/corotational_motion.hpp>
#include <ddacontact/core/sort_once.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ddacontact {

namespace {

/// Of K of the cells of a mesh and of a block of mean value functions: four points a triangle follow
/// neither hexagons nor the gradients at concave corners.
constexpr double fine = 1e-3;
/// Of more vertices Wachspress functions are integrated as finely: their gradients decay inwards from the
/// edges, and four points a triangle miss most of the stiffness (with 24 vertices a thirteenth is left).
constexpr int few_vertices = 8;
/// lambda over the shear modulus from which on displacements of polygons lock.
constexpr double nearly_incompressible = 9;

/// A matrix for x and y alike gives that of one axis.
MatrixXd of_one_axis(const MatrixXd& M) {
  return M(Eigen::seq(0, Eigen::last, 2), Eigen::seq(0, Eigen::last, 2));
}

MatrixXd stiffness_of(const polyfem::TabulatedElement& element, const Mat3& elasticity,
                      bool mean_dilatation) {
  MatrixXd K;
  if (mean_dilatation)
    polyfem::b_bar_stiffness(element, elasticity, K);
  else
    polyfem::stiffness(element, elasticity, K);
  return K;
}

ShapeCell polygon_cell(const BlockMaterial& material, const PointsRef& outline, const polyfem::Basis& basis,
                       const Integration& integration, bool mean_dilatation, double tolerance) {
  polyfem::TabulatedElement element;
  tabulate(outline, *integration.triangle_rule, basis, integration.correction, element);
  // Mass is exact for linear fields by the triangles' points, which a rule to a tolerance is not.
  MatrixXd M;
  polyfem::mass(element, M);
  polyfem::TabulatedElement finer;
  if (tolerance > 0) tabulate_to_tolerance(outline, basis, tolerance, integration.correction, finer);
  const MatrixXd K = stiffness_of(tolerance > 0 ? finer : element, material.elasticity, mean_dilatation);
  return {{},
          &basis,
          std::move(element),
          {outline, polyfem::mean_gradient_weights(outline), K},
          material.density * of_one_axis(M),
          mean_dilatation,
          {},
          {}};
}

/// What moves the nodes of each cell.
void find_unknowns(CorotationalShape& shape) {
  using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  for (ShapeCell& cell : shape.cells) {
    std::vector<int> nodes = cell.nodes;
    if (nodes.empty()) {
      nodes.resize(static_cast<std::size_t>(shape.nodes.cols()));
      std::iota(nodes.begin(), nodes.end(), 0);
    }
    std::vector<int> rows;
    for (int node : nodes) rows.insert(rows.end(), {2 * node, 2 * node + 1});
    cell.unknowns = rows;
    if (!shape.has_basis()) continue;
    cell.unknowns.clear();
    for (int row : rows)
      for (Row::InnerIterator entry(shape.basis, row); entry; ++entry)
        cell.unknowns.push_back(static_cast<int>(entry.col()));
    sort_once(cell.unknowns);
    cell.nodes_by_unknowns =
        MatrixXd::Zero(static_cast<Index>(rows.size()), static_cast<Index>(cell.unknowns.size()));
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (Row::InnerIterator entry(shape.basis, rows[k]); entry; ++entry) {
        const auto point = std::lower_bound(cell.unknowns.begin(), cell.unknowns.end(), entry.col());
        cell.nodes_by_unknowns(static_cast<Index>(k), point - cell.unknowns.begin()) = entry.value();
      }
  }
}

/// What moves each point, unless it has unknowns of its own.
void find_point_maps(CorotationalShape& shape) {
  if (shape.points.size() == 0 && !shape.has_basis()) return;
  const auto add = [&](Index node, double weight, std::vector<PointMap::Term>& terms) {
    for (int axis = 0; axis < 2; ++axis) {
      const Index row = 2 * node + axis;
      const Vec2 column = weight * Vec2::Unit(axis);
      if (!shape.has_basis()) {
        add_term(static_cast<int>(row), column, terms);
        continue;
      }
      for (decltype(shape.basis)::InnerIterator entry(shape.basis, row); entry; ++entry)
        add_term(static_cast<int>(entry.col()), entry.value() * column, terms);
    }
  };
  const bool are_nodes = shape.points.size() == 0;
  shape.point_maps.resize(static_cast<std::size_t>(are_nodes ? shape.nodes.cols() : shape.points.rows()));
  for (Index point = 0; point < static_cast<Index>(shape.point_maps.size()); ++point) {
    std::vector<PointMap::Term>& terms = shape.point_maps[static_cast<std::size_t>(point)];
    if (are_nodes) add(point, 1, terms);
    for (Index a = 0; a < shape.points.cols(); ++a)
      if (shape.points(point, a) != 0) add(a, shape.points(point, a), terms);
  }
}

/// What follows from nodes, cells and maps.
void complete(CorotationalShape& shape) {
  find_unknowns(shape);
  find_point_maps(shape);
  int n_points = 0, n_nodes = 0;
  for (ShapeCell& cell : shape.cells) {
    cell.first_point = n_points;
    cell.first_node = n_nodes;
    n_points += static_cast<int>(cell.element.n_points());
    n_nodes += static_cast<int>(cell.elastic.n_nodes());
  }
  shape.integration_weights.resize(n_points);
  for (const ShapeCell& cell : shape.cells)
    shape.integration_weights.segment(cell.first_point, cell.element.n_points()) = cell.element.rule.weights;
  shape.mass_of_translation = shape.is_one_cell() ? VectorXd(shape.cells[0].mass * shape.translation)
                                                  : VectorXd(shape.mass * shape.translation);
  shape.mass_total = shape.translation.dot(shape.mass_of_translation);
  shape.translations.resize(shape.n_unknowns(), 2);
  const NodalKinematics<polyfem::AnyNodes> nodes(shape);
  for (int axis = 0; axis < 2; ++axis)
    nodes.to_unknowns(nodes.everywhere(Vec2::Unit(axis)), shape.translations.col(axis));
}

/// A matrix of m nodes acting on x and y alike, 2m x 2m.
MatrixXd both_axes(const MatrixXd& M) {
  MatrixXd both = MatrixXd::Zero(2 * M.rows(), 2 * M.cols());
  for (int axis : {0, 1}) both(Eigen::seq(axis, Eigen::last, 2), Eigen::seq(axis, Eigen::last, 2)) = M;
  return both;
}

std::vector<MatrixXd> tangents(const CorotationalShape& shape, const StepRule& rule, double dt) {
  const double end_share = rule.mean_forces() ? 0.5 : 1,
               stiff = rule.is_explicit() ? 0 : end_share + rule.damping.stiffness / dt;
  std::vector<MatrixXd> tangents;
  for (const ShapeCell& cell : shape.cells)
    tangents.push_back(stiff * cell.elastic.stiffness() +
                       (rule.inertia() / (dt * dt) + rule.damping.mass / dt) * both_axes(cell.mass));
  return tangents;
}

}  // namespace

double CorotationalShape::highest_frequency() const {
  std::call_once(on_demand->vibrates, [this] {
    double& highest = on_demand->highest_frequency;
    for (const ShapeCell& cell : cells) {
      const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(
          cell.elastic.stiffness(), both_axes(cell.mass), Eigen::EigenvaluesOnly);
      highest = std::max(highest, std::sqrt(modes.eigenvalues().maxCoeff()));
    }
  });
  return on_demand->highest_frequency;
}

double critical_step(const CorotationalShape& shape, const RayleighDamping& damping) {
  const double w = shape.highest_frequency(), ratio = damping.stiffness * w / 2;
  return 2 / w / (std::hypot(1, ratio) + ratio);
}

double longest_explicit_step(const CorotationalShape& shape, const RayleighDamping& damping) {
  constexpr double margin = 0.9;
  return margin * critical_step(shape, damping);
}

std::shared_ptr<const StepMatrices> step_matrices(const CorotationalShape& shape, const StepRule& rule,
                                                  double dt) {
  const std::lock_guard lock(shape.on_demand->stepping);
  std::shared_ptr<const StepMatrices>& last = shape.on_demand->step;
  if (!last || !last->are_for(rule, dt))
    last = std::make_shared<const StepMatrices>(StepMatrices{rule, dt, tangents(shape, rule, dt)});
  return last;
}

CorotationalShape polygon_shape(const BlockMaterial& material, const PointsRef& block_outline,
                                const polyfem::Basis& basis, const Integration& integration) {
  CorotationalShape shape;
  shape.nodes = block_outline.colwise() - polyfem::area_moments(block_outline).centroid;
  const Index n = shape.nodes.cols();
  shape.translation = VectorXd::Ones(n);
  shape.cells.push_back(polygon_cell(material, shape.nodes, basis, integration, false,
                                     &basis == &polyfem::wachspress && n <= few_vertices ? 0 : fine));
  shape.n_outline = static_cast<int>(n);
  complete(shape);
  return shape;
}

CorotationalShape affine_shape(const BlockMaterial& material, const PointsRef& outline,
                               const std::optional<ControlVertices>& control) {
  const polyfem::AreaMoments moments = polyfem::area_moments(outline);
  const double size = std::sqrt(moments.area);
  CorotationalShape shape;
  constexpr Index n_nodes = ControlVertices::n;
  shape.nodes.resize(2, n_nodes);
  shape.nodes << Vec2::Zero(), size * Mat2::Identity();
  Points mean_gradient(2, n_nodes);
  mean_gradient << Vec2::Zero(), Mat2::Identity() / size;
  shape.translation = Vec3(1, 0, 0);

  polyfem::TabulatedElement element;
  element.area = moments.area;
  element.rule = {Vec2::Zero(), VectorXd::Constant(1, moments.area)};
  element.values = Eigen::RowVector3d(1, 0, 0);
  element.dx = Eigen::RowVector3d(0, 1 / size, 0);
  element.dy = Eigen::RowVector3d(0, 0, 1 / size);
  MatrixXd K;
  polyfem::stiffness(element, material.elasticity, K);

  MatrixXd mass = Mat3::Zero();
  mass(0, 0) = material.density * moments.area;
  mass.bottomRightCorner<2, 2>() = material.density / (size * size) * moments.second;
  shape.cells.push_back({{},
                         &polyfem::suitable_basis(outline),
                         std::move(element),
                         {shape.nodes, mean_gradient, shape.translation, K},
                         std::move(mass),
                         false,
                         {},
                         {}});

  const Index n = outline.cols();
  shape.n_outline = static_cast<int>(n);
  shape.points.resize(n, n_nodes);
  shape.points << VectorXd::Ones(n), (outline.colwise() - moments.centroid).transpose() / size;
  shape.nodes_of_points = shape.points.colPivHouseholderQr().solve(MatrixXd::Identity(n, n));

  if (control) {
    const Index n_unknowns = shape.nodes.size();
    MatrixXd displacements =
        MatrixXd::Zero(n_unknowns, n_unknowns);  // of the control vertices, by the changes of the nodes
    for (Index k = 0; k < n_nodes; ++k)
      for (Index a = 0; a < n_nodes; ++a) {
        displacements(2 * k, 2 * a) = shape.points(control->x[k], a);
        displacements(2 * k + 1, 2 * a + 1) = shape.points(control->y[k], a);
      }
    shape.basis = MatrixXd(displacements.inverse()).sparseView(1, length_round_off);
    shape.inverse_basis = displacements.sparseView();
  }
  complete(shape);
  return shape;
}

CorotationalShape mesh_shape(const BlockMaterial& material, const BlockMesh& mesh,
                             polyfem::GradientCorrection correction) {
  CorotationalShape shape;
  const Points outline = mesh.points.leftCols(mesh.n_outline);
  shape.nodes = mesh.points.colwise() - polyfem::area_moments(outline).centroid;
  const Index n = shape.nodes.cols();
  shape.n_outline = mesh.n_outline;
  shape.translation = VectorXd::Ones(n);

  const Mat3& D = material.elasticity;
  const bool mean_dilatation = D(0, 1) > nearly_incompressible * D(2, 2);
  for (const std::vector<int>& corners : mesh.cells) {
    const Points polygon = shape.nodes(Eigen::all, corners);
    const polyfem::Basis& basis = polyfem::suitable_basis(polygon);
    shape.cells.push_back(polygon_cell(
        material, polygon, basis, choose_integration(polygon, correction, basis), mean_dilatation, fine));
    shape.cells.back().nodes = corners;
  }

  shape.mass = sum_of_cells(shape, 1, [](const ShapeCell& cell) -> const MatrixXd& { return cell.mass; });

  if (!mesh.on_straight_edges.empty()) {
    const int independent = static_cast<int>(n) - static_cast<int>(mesh.on_straight_edges.size());
    std::vector<Eigen::Triplet<double>> basis;
    for (int u = 0; u < 2 * independent; ++u) basis.emplace_back(u, u, 1);
    shape.inverse_basis.resize(2 * independent, 2 * n);
    shape.inverse_basis.setFromTriplets(basis.begin(), basis.end());
    for (const BlockMesh::EdgePoint& on : mesh.on_straight_edges)
      for (int axis = 0; axis < 2; ++axis) {
        basis.emplace_back(2 * on.point + axis, 2 * on.start + axis, 1 - on.along);
        basis.emplace_back(2 * on.point + axis, 2 * on.end + axis, on.along);
      }
    shape.basis.resize(2 * n, 2 * independent);
    shape.basis.setFromTriplets(basis.begin(), basis.end());
  }
  complete(shape);
  return shape;
}

}  // namespace ddacontact
