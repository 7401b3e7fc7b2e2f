#include <polyfem/assembly/field_problem.hpp>

#include <polyfem/assembly/free_motion.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>

#include <cmath>
#include <sstream>
#include <utility>

namespace polyfem {
namespace {

/// What matrices rest on; everything else about a mesh is `find_defects`' business.
const PolygonMesh& checked(const PolygonMesh& mesh, int n_components) {
  if (n_components < 1)
    throw Error("a field of " + std::to_string(n_components) + " components: it needs one at least");
  require_numbering(mesh);
  std::vector<int> last_cell(static_cast<std::size_t>(mesh.vertices.cols()), -1);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c))
      if (std::exchange(last_cell[static_cast<std::size_t>(v)], c) == c)
        throw Error("cell " + std::to_string(c) + " has vertex " + std::to_string(v) + " twice");
  return mesh;
}

std::vector<int> expanded(const std::vector<int>& vertices, int n_components) {
  std::vector<int> unknowns;
  unknowns.reserve(vertices.size() * static_cast<std::size_t>(n_components));
  for (const int v : vertices)
    for (int c = 0; c < n_components; ++c) unknowns.push_back(n_components * v + c);
  return unknowns;
}

std::string words(const FreeMotion& motion, const PolygonMesh& mesh) {
  const std::string place = mesh.vertex_name(motion.vertex);
  if (motion.n_vertices == 1)
    return place +
           " belongs to no cell, and not all its unknowns are held: leave it out of the mesh, or hold them";
  const std::string part =
      "the part of the mesh with " + place + " (" + std::to_string(motion.n_vertices) + " vertices)";
  if (motion.translation.size() == 1)
    return part + " has no value to start from: hold one of its vertices at least";
  std::ostringstream text;
  text << part << " is held too little: free to move by (" << motion.translation.transpose() << ")";
  if (motion.rotation != 0) text << " while turning by " << motion.rotation << " at its farthest vertex";
  text << "; hold more of its unknowns, three that keep it from moving and turning at least";
  return text.str();
}

}  // namespace

FieldProblem::FieldProblem(const PolygonMesh& mesh, int n_components)
    : mesh_(&mesh),
      n_components_(n_components),
      matrix_(checked(mesh, n_components), n_components),
      held_(n_components * static_cast<int>(mesh.vertices.cols())),
      loads_(VectorXd::Zero(n_components * mesh.vertices.cols())),
      cell_loads_(loads_),
      u_(loads_),
      reactions_(loads_) {}

int FieldProblem::unknown(int vertex, int component) const {
  if (vertex < 0 || vertex >= mesh_->vertices.cols() || component < 0 || component >= n_components_)
    throw Error("there is no component " + std::to_string(component) + " of vertex " +
                std::to_string(vertex) + " in a problem of " + std::to_string(n_components_) +
                " components and " + std::to_string(mesh_->vertices.cols()) + " vertices");
  return n_components_ * vertex + component;
}

void FieldProblem::hold(int vertex, int component, double value) {
  const int k = unknown(vertex, component);
  if (!std::isfinite(value))
    throw Error(mesh_->vertex_name(vertex) + " is held at a value that is not finite");
  if (held_.hold(k, value)) factorized_ = false;
}

void FieldProblem::release_all() {
  held_.release_all();
  factorized_ = false;
}

void FieldProblem::add_load(int vertex, int component, double value) {
  const int k = unknown(vertex, component);
  if (!std::isfinite(value)) throw Error(mesh_->vertex_name(vertex) + " gets a load that is not finite");
  loads_[k] += value;
}

void FieldProblem::add_edge_loads(std::span<const std::array<int, 2>> edges, const EdgeLoad& load) {
  const GaussRule& rule = gauss_rule(3);
  for (const auto& [first, second] : edges) {
    const int i = unknown(first, 0), j = unknown(second, 0);
    const Vec2 a = mesh_->vertices.col(first), edge = mesh_->vertices.col(second) - a;
    const double length = edge.norm();
    const auto refuse = [&, first = first, second = second](const std::string& reason) {
      throw Error("the load on the edge from " + mesh_->vertex_name(first) + " to " +
                  mesh_->vertex_name(second) + " " + reason);
    };
    if (!(length > 0)) refuse("has no direction: give it two vertices at different places");
    for (Index q = 0; q < rule.points.size(); ++q) {
      const double t = rule.points[q];
      const VectorXd value = load(a + t * edge, Vec2(edge.y(), -edge.x()) / length);
      if (value.size() != n_components_)
        refuse("has " + std::to_string(value.size()) + " entries: give it one for each of " +
               std::to_string(n_components_) + " components");
      if (!value.allFinite()) refuse("is not finite");
      loads_.segment(i, n_components_) += rule.weights[q] * length * (1 - t) * value;
      loads_.segment(j, n_components_) += rule.weights[q] * length * t * value;
    }
  }
}

void FieldProblem::clear_loads() {
  loads_.setZero();
  cell_loads_.setZero();
}

void FieldProblem::assemble(const CellMatrix& cell_matrix) {
  held_.forget_couplings();
  matrix_.set_zero();
  cell_loads_.setZero();
  assembled_ = factorized_ = false;
  Points polygon;
  MatrixXd K;
  VectorXd f;
  for (int c = 0; c < mesh_->n_cells(); ++c) {
    const std::span<const int> corners = mesh_->cell(c);
    const Index n = static_cast<Index>(corners.size());
    if (polygon.cols() < n) polygon.resize(2, n);
    for (Index k = 0; k < n; ++k) polygon.col(k) = mesh_->vertices.col(corners[k]);
    f.setZero(n_components_ * n);
    try {
      cell_matrix(c, polygon.leftCols(n), K, f);
    } catch (const Error& error) {
      throw Error("cell " + std::to_string(c) + ": " + error.what());
    }
    if (K.rows() != f.size() || K.cols() != f.size() || f.size() != n_components_ * n)
      throw Error("the matrix of cell " + std::to_string(c) + " is " + std::to_string(K.rows()) + " x " +
                  std::to_string(K.cols()) + ", its load " + std::to_string(f.size()) +
                  ": both need one row for each of " + std::to_string(n_components_ * n) + " unknowns");
    if (!K.allFinite() || !f.allFinite())
      throw Error("the matrix or load of cell " + std::to_string(c) +
                  " is not finite: look for a defect of the mesh there, or of what fills it");
    matrix_.add(c, K);
    for (Index k = 0; k < n; ++k)
      cell_loads_.segment(n_components_ * corners[k], n_components_) +=
          f.segment(n_components_ * k, n_components_);
  }
  assembled_ = true;
}

const VectorXd& FieldProblem::solve() {
  if (!assembled_) throw Error("a field is asked for before its problem is assembled: call assemble first");
  if (!factorized_) factorize();
  const VectorXd loads = loads_ + cell_loads_;
  VectorXd f = loads;
  held_.move_to_right_hand_side(f);
  cholesky_.solve(f, u_);
  held_.set_values(u_);
  reactions_ = held_.forces(u_);
  for (int k = 0; k < n_unknowns(); ++k)
    if (held_.is_held(k)) reactions_[k] -= loads[k];
  return u_;
}

void FieldProblem::factorize() {
  held_.put_back(matrix_.lower());
  held_.take_out(matrix_.lower());
  if (const auto motion = find_free_motion(*mesh_, n_components_, matrix_.lower(), held_))
    throw Error(words(*motion, *mesh_));
  if (cholesky_.n_analyses() == 0) {
    const std::vector<int> order = minimum_degree_order(matrix_.first_neighbours(), matrix_.neighbours());
    cholesky_.analyze(matrix_.lower(), expanded(order, n_components_));
  }
  factorized_ = cholesky_.factorize(matrix_.lower());
  if (!factorized_)
    throw Error("the matrix is not positive definite (noticed at " +
                mesh_->vertex_name(cholesky_.failed_row() / n_components_) +
                ") though no part of the mesh is free to move: look for cells whose matrix has no or "
                "negative energies, by a rule of too few points or a material that is not stable");
}

}  // namespace polyfem
