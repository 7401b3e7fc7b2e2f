#include <polyfem/assembly/field_problem.hpp>

#include <polyfem/assembly/elimination_order.hpp>
#include <polyfem/assembly/field_values.hpp>
#include <polyfem/assembly/free_motion.hpp>
#include <polyfem/assembly/refined_solution.hpp>
#include <polyfem/core/error.hpp>

#include <cmath>
#include <sstream>
#include <utility>

namespace polyfem {
namespace {

/// What matrices rest on; everything else about a mesh is `find_defects`' business.
const PolygonMesh& checked(const PolygonMesh& mesh, int n_components) {
  if (n_components < 1)
    throw Error("a field of " + std::to_string(n_components) + " components: it needs one at least");
  if (mesh.vertices.cols() == 0) throw Error("the mesh has no vertices: a field needs some");
  require_numbering(mesh);
  std::vector<int> last_cell(static_cast<std::size_t>(mesh.vertices.cols()), -1);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c))
      if (std::exchange(last_cell[static_cast<std::size_t>(v)], c) == c)
        throw Error("cell " + std::to_string(c) + " has vertex " + std::to_string(v) + " twice");
  return mesh;
}

/// What a symmetric matrix may differ by from its transpose, over its largest entry: half of the digits,
/// which no rounding takes.
constexpr double largest_asymmetry = 1e-8;
/// Energies above minus this, over the largest entry of a cell's matrix, may be those of rigid motions.
constexpr double rigid_energy = 1e-10;

/// By one factor: refinements of so many have taken as long as a factor in double precision does.
constexpr int many_solutions = 8;

/// The reason and the cure, or nothing when K is symmetric.
std::string asymmetry(const MatrixXd& K, double largest) {
  const auto difference = K - K.transpose();
  if (difference.lpNorm<Eigen::Infinity>() <= largest_asymmetry * largest) return {};
  Index i = 0, j = 0;
  difference.cwiseAbs().maxCoeff(&i, &j);
  std::ostringstream text;
  text << "is not symmetric: K(" << i << ", " << j << ") = " << K(i, j) << ", K(" << j << ", " << i
       << ") = " << K(j, i)
       << "; fill both triangles, or state Symmetry::none for forms that are not symmetric, as those of "
          "convection";
  return text.str();
}

/// Whether some u has u.Ku < -shift u.u: elimination meets a pivot that is not positive then. `left` is what
/// is left of the matrix to eliminate.
bool has_negative_energy(const MatrixXd& K, double shift, MatrixXd& left) {
  left = K;
  const Index n = K.rows();
  for (Index j = 0; j < n; ++j) {
    const double pivot = left(j, j) + shift;
    if (pivot < 0) return true;
    if (pivot == 0) continue;  // of a zero matrix
    for (Index k = j + 1; k < n; ++k) left.col(k).tail(n - k) -= left(k, j) / pivot * left.col(j).tail(n - k);
  }
  return false;
}

/// The matrix of a cell whose lower triangle holds the entries below the diagonal of the whole matrix, where
/// vertices may have the other order.
MatrixXd in_order_of(std::span<const int> vertices, const Eigen::Ref<const MatrixXd>& K, int n_components) {
  MatrixXd ordered = K;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (vertices[i] > vertices[j]) continue;
      const auto row = static_cast<Index>(i) * n_components, column = static_cast<Index>(j) * n_components;
      ordered.block(row, column, n_components, n_components) =
          K.block(column, row, n_components, n_components).transpose();
    }
  return ordered;
}

std::vector<int> expanded(const std::vector<int>& vertices, int n_components) {
  std::vector<int> unknowns;
  unknowns.reserve(vertices.size() * static_cast<std::size_t>(n_components));
  for (const int v : vertices)
    for (int c = 0; c < n_components; ++c) unknowns.push_back(n_components * v + c);
  return unknowns;
}

std::string words(const FreeMotion& motion, const PolygonMesh& mesh) {
  const std::string slot = mesh.vertex_name(motion.vertex);
  if (motion.n_vertices == 1)
    return slot +
           " belongs to no cell, and not all its unknowns are held: leave it out of the mesh, or hold them";
  const std::string part =
      "the part of the mesh with " + slot + " (" + std::to_string(motion.n_vertices) + " vertices)";
  if (motion.translation.size() == 1)
    return part + " has no value to start from: hold one of its vertices at least";
  std::ostringstream text;
  text << part << " is held too little: free to move by (" << motion.translation.transpose() << ")";
  if (motion.rotation != 0) text << " while turning by " << motion.rotation << " at its farthest vertex";
  text << "; hold more of its unknowns, three that keep it from moving and turning at least";
  return text.str();
}

}  // namespace

FieldProblem::FieldProblem(const PolygonMesh& mesh, int n_components, Symmetry symmetry)
    : mesh_(&mesh),
      n_components_(n_components),
      cells_at_(checked(mesh, n_components)),
      matrix_(mesh, n_components),
      prescribed_(n_components * static_cast<int>(mesh.vertices.cols())),
      loads_(VectorXd::Zero(n_components * mesh.vertices.cols())),
      cell_loads_(loads_),
      u_(loads_),
      reactions_(loads_) {
  if (symmetry == Symmetry::none) transposed_.emplace(mesh, n_components);
}

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
  if (tied_.is_tied(k)) throw Error(mesh_->vertex_name(vertex) + " is tied: it cannot be held as well");
  if (prescribed_.hold(k, value) || !tied_.empty() || transposed_) factorized_ = false;
}

void FieldProblem::tie(int vertex, int component, const std::vector<Followed>& followed, double constant) {
  const int k = unknown(vertex, component);
  if (prescribed_.is_prescribed(k))
    throw Error(mesh_->vertex_name(vertex) + " is held: it cannot be tied as well");
  bool finite = std::isfinite(constant);
  std::vector<TieTerm> terms;
  for (const Followed& other : followed) {
    finite = finite && std::isfinite(other.factor);
    terms.push_back({unknown(other.vertex, other.component), other.factor});
  }
  if (!finite) throw Error(mesh_->vertex_name(vertex) + " is tied by a number that is not finite");
  tied_.tie(k, std::move(terms), constant);
  factorized_ = false;
}

int FieldProblem::roll(int vertex, const Vec2& normal, double value) {
  if (n_components_ != 2)
    throw Error("rollers are for fields of two components: this one has " + std::to_string(n_components_));
  if (!(normal.norm() > 0) || !normal.allFinite())
    throw Error(mesh_->vertex_name(vertex) + " rolls on an edge whose normal is (" +
                std::to_string(normal.x()) + ", " + std::to_string(normal.y()) +
                "): give one that is finite and not zero");
  const int steep = std::abs(normal.x()) > std::abs(normal.y()) ? 0 : 1;
  const double along = normal[1 - steep] / normal[steep];
  if (along == 0)
    tie(vertex, steep, {}, value / normal[steep]);
  else
    tie(vertex, steep, {{vertex, 1 - steep, -along}}, value / normal[steep]);
  return steep;
}

void FieldProblem::release_all() {
  prescribed_.release_all();
  tied_.release_all();
  factorized_ = false;
}

void FieldProblem::add_load(int vertex, int component, double value) {
  const int k = unknown(vertex, component);
  if (!std::isfinite(value)) throw Error(mesh_->vertex_name(vertex) + " gets a load that is not finite");
  loads_[k] += value;
}

void FieldProblem::add_loads(const Eigen::Ref<const VectorXd>& loads) {
  if (loads.size() != n_unknowns() || !loads.allFinite())
    throw Error("loads on all unknowns have " + std::to_string(loads.size()) +
                " entries, or some that are not finite: give a number for each of " +
                std::to_string(n_unknowns()) + " unknowns");
  loads_ += loads;
}

void FieldProblem::clear_loads() {
  loads_.setZero();
  cell_loads_.setZero();
}

void FieldProblem::assemble(const CellMatrix& cell_matrix) {
  prescribed_.forget_couplings();
  matrix_.set_zero();
  if (transposed_) transposed_->set_zero();
  cell_loads_.setZero();
  assembled_ = factorized_ = false;
  first_negative_cell_ = -1;
  n_negative_cells_ = 0;
  Points polygon;
  MatrixXd K, left;
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
    const double largest = K.lpNorm<Eigen::Infinity>();
    if (transposed_) {
      matrix_.add(c, in_order_of(corners, K, n_components_));
      transposed_->add(c, in_order_of(corners, K.transpose(), n_components_));
    } else {
      if (const std::string reason = asymmetry(K, largest); !reason.empty())
        throw Error("the matrix of cell " + std::to_string(c) + " " + reason);
      if (has_negative_energy(K, rigid_energy * largest, left) && n_negative_cells_++ == 0)
        first_negative_cell_ = c;
      matrix_.add(c, K);
    }
    for (Index k = 0; k < n; ++k)
      cell_loads_.segment(n_components_ * corners[k], n_components_) +=
          f.segment(n_components_ * k, n_components_);
  }
  assembled_ = true;
}

const VectorXd& FieldProblem::solve() {
  if (!assembled_) throw Error("a field needs an assembled problem: call assemble first");
  if (!factorized_) factorize();
  const VectorXd loads = this->loads();
  if (transposed_ || !tied_.empty()) {
    u_ = reduced_.solve(loads);
    reactions_ = reduced_.reactions(u_, loads);
    return u_;
  }
  VectorXd f = loads;
  prescribed_.move_to_right_hand_side(f);
  if (rough_ && n_refined_++ == many_solutions) factorize_in_double_precision();
  if (!rough_ || !refined_solution(matrix_.lower(), cholesky_, f, u_)) {
    if (rough_) {
      roughly_ = false;
      factorize_in_double_precision();
    }
    cholesky_.solve(f, u_);
  }
  prescribed_.set_values(u_);
  reactions_ = prescribed_.forces(u_);
  for (int k = 0; k < n_unknowns(); ++k)
    if (prescribed_.is_prescribed(k)) reactions_[k] -= loads[k];
  return u_;
}

VectorXd FieldProblem::cell_solution(int cell) const {
  return cell_values(*mesh_, cell, u_);
}

const SparseMatrix& FieldProblem::matrix() {
  if (!assembled_) throw Error("a matrix needs an assembled problem: call assemble first");
  if (transposed_)
    throw Error("the matrix is not symmetric, its lower triangle is not all of it: use full_matrix");
  prescribed_.put_back(matrix_.lower());
  factorized_ = false;
  return matrix_.lower();
}

SparseMatrix FieldProblem::full_matrix() {
  if (!transposed_) return matrix().selfadjointView<Eigen::Lower>();
  if (!assembled_) throw Error("a matrix needs an assembled problem: call assemble first");
  const SparseMatrix upper =
      SparseMatrix(transposed_->lower().triangularView<Eigen::StrictlyLower>()).transpose();
  return matrix_.lower() + upper;
}

void FieldProblem::pass_on(VectorXd& forces) const {
  if (!tied_.empty()) {
    const Reduction reduction = tied_.reduce(prescribed_, n_unknowns());
    const VectorXd felt = reduction.T.transpose() * forces;
    forces.setZero();
    for (int k = 0, column = 0; k < n_unknowns(); ++k)
      if (!tied_.is_tied(k) && !prescribed_.is_prescribed(k)) forces[k] = felt[column++];
  }
  for (int k = 0; k < n_unknowns(); ++k)
    if (prescribed_.is_prescribed(k)) forces[k] = 0;
}

/// T^T K T, by Cholesky or LU.
void FieldProblem::factorize_reduced() {
  if (const auto motion =
          transposed_ ? std::nullopt : find_free_motion(*mesh_, n_components_, matrix(), prescribed_, tied_))
    throw Error(words(*motion, *mesh_));
  factorized_ = reduced_.set(full_matrix(), tied_.reduce(prescribed_, n_unknowns()), !transposed_);
  if (factorized_) return;
  if (transposed_)
    throw Error(
        "the matrix is singular: hold or tie more unknowns, or look for cells with deformations that cost "
        "nothing");
  refuse_indefinite(reduced_.failed_unknown());
}

void FieldProblem::factorize() {
  if (transposed_ || !tied_.empty()) {
    factorize_reduced();
    return;
  }
  prescribed_.put_back(matrix_.lower());
  prescribed_.take_out(matrix_.lower());
  if (const auto motion = find_free_motion(*mesh_, n_components_, matrix_.lower(), prescribed_, tied_))
    throw Error(words(*motion, *mesh_));
  if (!cholesky_.is_analyzed()) {
    const std::vector<int> order =
        elimination_order(*mesh_, cells_at_, matrix_.first_neighbours(), matrix_.neighbours());
    cholesky_.analyze(matrix_.lower(), expanded(order, n_components_));
  }
  factorized_ = rough_ = roughly_ = roughly_ && cholesky_.factorize_roughly(matrix_.lower());
  n_refined_ = 0;
  if (!rough_) factorize_in_double_precision();
}

void FieldProblem::factorize_in_double_precision() {
  rough_ = false;
  factorized_ = cholesky_.factorize(matrix_.lower());
  if (!factorized_) refuse_indefinite(cholesky_.failed_row());
}

void FieldProblem::refuse_indefinite(int unknown) const {
  const std::string indefinite = "the matrix is not positive definite (noticed at " +
                                 mesh_->vertex_name(unknown / n_components_) +
                                 ") though no part of the mesh is free to move: ";
  if (n_negative_cells_ > 0)
    throw Error(
        indefinite + "the matrix of cell " + std::to_string(first_negative_cell_) +
        (n_negative_cells_ > 1 ? ", the first of " + std::to_string(n_negative_cells_) + " such," : "") +
        " has a negative energy: give it a rule without negative weights (dunavant_rule, "
        "tabulate_to_tolerance) and a stable material");
  throw Error(indefinite +
              "look for cells with deformations that cost no energy, by a rule of too few points or "
              "a material without stiffness");
}

}  // namespace polyfem
