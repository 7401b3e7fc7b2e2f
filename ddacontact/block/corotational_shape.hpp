/// \file Data that congruent corotational blocks share: nodes, matrices and maps of the reference shape.
#pragma once

#include <ddacontact/block/block.hpp>
#include <ddacontact/block/block_mesh.hpp>
#include <ddacontact/block/control_vertices.hpp>
#include <ddacontact/block/integration.hpp>
#include <ddacontact/block/motion_shape.hpp>
#include <ddacontact/block/step_start.hpp>
#include <polyfem/element/corotation.hpp>

#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace ddacontact {

/// The tangents of a shape's cells in a step by this rule and of this length, not turned.
struct StepMatrices {
  StepRule rule;
  double dt = 0;
  std::vector<MatrixXd> tangents;

  bool are_for(const StepRule& of_rule, double of_dt) const { return rule == of_rule && dt == of_dt; }
};

/// A part of a block with a frame and a stiffness of its own.
struct ShapeCell {
  std::vector<int> nodes;             ///< of the shape; empty: all of them
  const polyfem::Basis* basis;        ///< of its functions on its corners; not owned
  polyfem::TabulatedElement element;  ///< functions of its nodes where stresses are taken
  polyfem::CorotatedElement elastic;  ///< K of (17) and its frame
  MatrixXd mass;                      ///< density * integral of N_a N_b
  bool mean_dilatation = false;       ///< K and stresses by polyfem/element/b_bar
  std::vector<int> unknowns;          ///< of the block, that move its nodes
  MatrixXd nodes_by_unknowns;         ///< changes of its nodes by these; empty: they are the same
  int first_point = 0;                ///< among the stress points of the block
  int first_node = 0;                 ///< where the nodes of all cells stand one after another
};

/// A block's nodes are 2-vectors that turn with it; its unknowns are their changes in a step. For polygons
/// and meshes they are its points. For Shi's affine displacements they are the centroid and the two columns
/// of F = dx/dX, times the block's size, which makes them lengths: six unknowns, linear in (1) at any
/// rotation.
struct CorotationalShape {
  Points nodes;          ///< at rest, 2 x m, from the centroid of the outline
  VectorXd translation;  ///< of each node when the block is shifted by 1
  std::vector<ShapeCell> cells;
  Eigen::SparseMatrix<double> mass;  ///< of all nodes, the sum over the cells; empty: that of the only one
  int n_outline = 0;                 ///< vertices of the outline, the first of the points
  MatrixXd points;           ///< p x m: point i is at sum_a points(i, a) y_a; empty: the nodes are the points
  MatrixXd nodes_of_points;  ///< m x p: exact for points of this shape
  /// Changes of the nodes by the unknowns, 2m x u, and back; empty: they are the unknowns.
  Eigen::SparseMatrix<double, Eigen::RowMajor> basis, inverse_basis;

  Eigen::Matrix<double, Eigen::Dynamic, 2> translations{};  ///< see Block::translations
  VectorXd mass_of_translation{};                           ///< M t
  double mass_total = 0;                                    ///< t M t
  /// Of every point, by the unknowns; empty: each point has two unknowns of its own.
  std::vector<std::vector<PointMap::Term>> point_maps{};
  VectorXd integration_weights{};  ///< of the points of all cells

  /// The shape in its own frame, found when it is first requested. Any thread may ask.
  const MotionShape& motions() const {
    std::call_once(on_demand->found, [this] { on_demand->motions.emplace(*this); });
    return *on_demand->motions;
  }
  /// A bound of the angular frequencies at which the free shape vibrates, the highest of its cells by
  /// themselves, 1/s; found when it is first requested. Any thread may ask.
  double highest_frequency() const;
  /// Results that are found when first requested, and the step matrices that were requested last.
  struct OnDemand {
    std::once_flag found, vibrates;
    std::optional<MotionShape> motions;
    double highest_frequency = 0;
    std::mutex stepping;
    std::shared_ptr<const StepMatrices> step;
  };
  std::unique_ptr<OnDemand> on_demand = std::make_unique<OnDemand>();

  /// Whether the only cell has all nodes in their order.
  bool is_one_cell() const { return cells[0].nodes.empty(); }
  bool has_basis() const { return basis.size() > 0; }
  Index n_unknowns() const { return has_basis() ? basis.cols() : 2 * nodes.cols(); }
};

/// The sum of matrices of the cells, which have `per_node` rows and columns for each node of their own.
Eigen::SparseMatrix<double> sum_of_cells(const CorotationalShape& shape, int per_node,
                                         const std::function<const MatrixXd&(const ShapeCell&)>& of_cell);

/// The step below which central differences are stable for the shape: with damping, whose forces are those of
/// velocities half a step before, (2 / w) (sqrt(1 + z^2) - z) with the damping ratio z at the highest
/// frequency w; s.
double critical_step(const CorotationalShape& shape, const RayleighDamping& damping);
/// Critical step with a margin, as blocks turn and lengths of substeps change, s.
double longest_explicit_step(const CorotationalShape& shape, const RayleighDamping& damping);

/// Step matrices by this rule and length: those that were last requested of the shape, or made now. Any
/// thread may ask.
std::shared_ptr<const StepMatrices> step_matrices(const CorotationalShape& shape, const StepRule& rule,
                                                  double dt);

/// One cell, the outline, by a basis that is suitable for it.
CorotationalShape polygon_shape(const BlockMaterial& material, const PointsRef& outline,
                                const polyfem::Basis& basis, const Integration& integration);

/// With control vertices their displacements are the unknowns (u v u v u v), so that holding one is leaving
/// out its unknowns.
CorotationalShape affine_shape(const BlockMaterial& material, const PointsRef& outline,
                               const std::optional<ControlVertices>& control = std::nullopt);

/// Many cells, each by the basis that suits it; of mean dilatation where the material is nearly
/// incompressible (lambda above nine times the shear modulus: nu above .45 in plane strain).
/// \param[in] mesh  of the outline, in any coordinates
CorotationalShape mesh_shape(const BlockMaterial& material, const BlockMesh& mesh,
                             polyfem::GradientCorrection correction);

}  // namespace ddacontact
