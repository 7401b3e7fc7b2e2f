/// \file From a mesh to a field on it: unknowns at vertices, some held or tied, loads, one sparse system.
#pragma once

#include <polyfem/assembly/mesh_matrix.hpp>
#include <polyfem/assembly/prescribed_dofs.hpp>
#include <polyfem/assembly/reduced_system.hpp>
#include <polyfem/mesh/vertex_cells.hpp>

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace polyfem {

/// Whether the matrices of cells are symmetric: systems without symmetry are solved by UMFPACK.
enum class Symmetry { symmetric, none };

/// What a component of a vertex follows: factor times that of another vertex.
struct Followed {
  int vertex, component;
  double factor = 1;
};

/// One field on a mesh: n_components unknowns a vertex, unknown c of vertex v being n_components v + c.
///
///     FieldProblem problem(mesh, 1);
///     problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) { ... });
///     for (int v : boundary_vertices(mesh)) problem.hold(v, 0);
///     const VectorXd& u = problem.solve();
///
/// Holding, loading and assembling come in any order and may be repeated between solutions; what is still
/// good is kept: the analysis for as long as the problem lives, the factor until the matrix or the set of
/// prescribed degrees of freedom changes. So further right hand sides, and other values at prescribed degrees
/// of freedom, cost a substitution. With ties, or without symmetry, another value at a prescribed degree of
/// freedom costs a factor as well.
///
/// Large systems are factorized in single precision, of half the memory and time, and their solutions refined
/// to the last digits of double precision (see `refined_solution`). Where that fails, as in ill-conditioned
/// systems, a factor in double precision takes its place, and so it does for the ninth right hand side.
///
/// Factors are made by the BLAS in use: `pin_blas_to_one_thread` first, if the last bits must not depend on
/// the number of its threads (small problems are faster, too).
class FieldProblem {
 public:
  /// Fills K (square, symmetric) and f for the unknowns of a cell's vertices in order; `polygon` is the
  /// cell's outline. K and f come with what the last call left in them, f set to zero in the right size.
  using CellMatrix = std::function<void(int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f)>;
  /// Load per unit length at a point of the boundary, n_components entries.
  using EdgeLoad = std::function<VectorXd(const Vec2& x, const Vec2& outward_normal)>;

  /// \param[in] mesh  kept by reference: must live longer and not change. Checked for what would break this
  ///                  class (no vertices; see `require_numbering`; a vertex twice in a cell): throws Error,
  ///                  as for less than one component. See `require_valid` for the rest.
  FieldProblem(const PolygonMesh& mesh, int n_components, Symmetry symmetry = Symmetry::symmetric);
  FieldProblem(PolygonMesh&&, int, Symmetry = Symmetry::symmetric) = delete;

  /// Prescribes an unknown; once more to change its value.
  void hold(int vertex, int component, double value = 0);
  /// Makes an unknown follow others: u = constant + the sum of factor times them; once more to change it.
  /// Those may be held, or tied themselves, but not in a circle (refused when solving). Throws Error for an
  /// unknown that is held as well, and for numbers that are not finite.
  void tie(int vertex, int component, const std::vector<Followed>& followed, double constant = 0);
  /// Of two components: a vertex slides along a straight edge, u.normal = value, as on rollers. The normal's
  /// length does not matter to the edge, but `value` is divided by it. Returns the component that is tied to
  /// the other. Throws Error where it is zero, or
  /// where there are other than two components.
  int roll(int vertex, const Vec2& normal, double value = 0);
  /// Frees all held and tied unknowns.
  void release_all();

  /// Adds to the load on an unknown; throws Error unless it is finite.
  void add_load(int vertex, int component, double value);
  /// Adds to the loads on all unknowns; throws Error unless there are as many and all are finite.
  void add_loads(const Eigen::Ref<const VectorXd>& loads);
  /// Adds the integrals of N_i times a load over edges of cells: three Gauss points an edge, exact for loads
  /// up to degree 4 along it (shape functions are linear there). Edges run in their cell's direction, as
  /// `boundary_edges` gives them: the normal is to their right. Throws Error for no edge at all, for one that
  /// no cell has or that runs against its cell, for one without length, for loads of the wrong size or not
  /// finite, and on meshes of quadratic cells; then nothing is added.
  void add_edge_loads(std::span<const std::array<int, 2>> edges, const EdgeLoad& load);
  /// The same for edges (first, middle, last) of quadratic cells, as `quadratic_boundary_edges` gives them:
  /// exact for loads up to degree 3 along an edge. `quadratic_edges` makes them of pairs, as named groups
  /// have. Throws Error also when `middle` is not in the middle.
  void add_edge_loads(std::span<const std::array<int, 3>> edges, const EdgeLoad& load);
  /// Drops all loads, those of the cells included, to begin another right hand side.
  void clear_loads();

  /// Assembles matrix and loads of the cells, in place of what was assembled before. Throws Error, with the
  /// cell, for what `cell_matrix` throws, for a matrix or load of the wrong size or not finite, and for a
  /// matrix that is not symmetric to 1e-8 of its largest entry, unless the problem is without symmetry.
  void assemble(const CellMatrix& cell_matrix);

  /// The field with the held values and, for all other unknowns, K u = f. Throws Error when the matrix is not
  /// positive definite, naming a part of the mesh that is free to move if that is why, or else the first cell
  /// whose matrix has a negative energy u.Ku. A problem without symmetry only has to be regular.
  const VectorXd& solve();

  /// The last solution.
  const VectorXd& solution() const { return u_; }
  /// Loads needed at prescribed degrees of freedom beyond those applied, K u - f, and what ties exert on what
  /// they tie; zero elsewhere. Of the last solution, whatever was changed since; zero before.
  const VectorXd& reactions() const { return reactions_; }

  /// The number of an unknown: its row in the matrix and in all vectors. Throws Error when there is none.
  int unknown(int vertex, int component) const;
  /// The last solution at the vertices of a cell, in the order of its element's unknowns.
  VectorXd cell_solution(int cell) const;
  /// The lower triangle of the matrix as assembled, with no unknown held, without a copy:
  /// `matrix().selfadjointView<Eigen::Lower>()` is all of it. Good until the next call that is not const; the
  /// next solution makes a factor anew. Throws Error before `assemble`.
  const SparseMatrix& matrix();
  /// Both triangles of it, a copy; also of a problem without symmetry, for which `matrix` throws Error.
  SparseMatrix full_matrix();
  /// Moves the forces on tied unknowns to what they follow, and leaves zero there and at held ones: what free
  /// unknowns feel of them.
  void pass_on(VectorXd& forces) const;
  /// The right hand side: loads of vertices, edges and cells, with no unknown held.
  VectorXd loads() const { return loads_ + cell_loads_; }
  const TiedUnknowns& tied() const { return tied_; }
  bool is_prescribed(int unknown) const { return prescribed_.is_prescribed(unknown); }

  int n_unknowns() const { return static_cast<int>(u_.size()); }
  int n_analyses() const { return cholesky_.n_analyses(); }
  int n_factorizations() const { return cholesky_.n_factorizations(); }
  int n_solves() const { return cholesky_.n_solves(); }

 private:
  void require_edge(int first, int second) const;
  template <std::size_t n>
  void add_loads_on(std::span<const std::array<int, n>> edges, const EdgeLoad& load);
  void factorize();
  void factorize_reduced();
  void factorize_in_double_precision();
  [[noreturn]] void refuse_indefinite(int unknown) const;

  const PolygonMesh* mesh_;
  int n_components_;
  VertexCells cells_at_;
  MeshMatrix matrix_;                     ///< with the held rows and columns taken out once it is factorized
  std::optional<MeshMatrix> transposed_;  ///< without symmetry: the upper triangle as a lower one
  PrescribedDofs prescribed_;
  TiedUnknowns tied_;
  VectorXd loads_, cell_loads_, u_, reactions_;
  Cholesky cholesky_;
  ReducedSystem reduced_;  ///< with ties or without symmetry
  bool assembled_ = false, factorized_ = false;
  bool rough_ = false;   ///< the factor is in single precision: solutions are refined
  bool roughly_ = true;  ///< factors in single precision are tried: none has been too little
  int n_refined_ = 0;    ///< solutions by the factor in single precision
  int first_negative_cell_ = -1, n_negative_cells_ = 0;  ///< cells whose matrices have a negative energy
};

/// A pressure p, N/m^2, on displacements: the load -p n on edges with the outward normal n.
FieldProblem::EdgeLoad pressure(double p);

}  // namespace polyfem
