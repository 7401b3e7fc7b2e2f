/// \file THE interface: one block of the system, whatever its unknowns.
#pragma once

#include <ddacontact/block/block_step.hpp>
#include <ddacontact/block/point_map.hpp>
#include <polyfem/basis/basis.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cmath>
#include <memory>
#include <vector>

namespace ddacontact {

struct CorotationalShape;

/// Motions of a block as a rigid body, a row an unknown: unit translations in x and y, and a unit rotation.
using RigidModes = Eigen::Matrix<double, Eigen::Dynamic, BlockState::n_rigid>;

/// Material of a block.
struct BlockMaterial {
  Mat3 elasticity;     ///< D of (9), Pa
  double density = 0;  ///< at the start, kg/m3
};

/// A polygon of a block: inside it the stress is smooth.
struct BlockCell {
  std::vector<int> corners;               ///< points of the block, counter-clockwise
  const polyfem::Basis* basis = nullptr;  ///< its shape functions; not owned
};

/// The stress in a cell: elasticity * B(x) strain_displacement + offset, with B of (8) by the functions of
/// the cell on its present corners.
struct CellStress {
  Points strain_displacement;  ///< m, one a corner
  Mat3 elasticity;             ///< Pa
  Vec3 offset;                 ///< Pa
};

/// One block of (13): how its unknowns move its outline, and with what forces it resists them.
///
/// A block's points are those whose positions the state keeps: first the vertices of its outline,
/// counter-clockwise, which contacts act on, then the corners of its cells that lie inside or on an edge.
///
/// Unknowns, points and integration points are ranges of the arrays of BlockState, given once by
/// `number`. From then on a block does not change: what does is in the state, and what a step needs in its
/// BlockStep. Vectors of one block are in the order of its own unknowns. Forces are per metre of thickness.
class Block {
 public:
  virtual ~Block() = default;
  Block& operator=(const Block&) = delete;
  /// The same block once more, which may get other numbers.
  virtual std::unique_ptr<Block> copy() const = 0;
  /// Whether its maps and matrices are those of its present shape.
  virtual bool follows_shape() const { return false; }
  /// Of a block that follows it: the block with the maps and matrices of its shape in `state`.
  virtual std::unique_ptr<Block> reshaped(const BlockState& /*state*/) const { return copy(); }

  /// The shape whose motions carry the block on; null: it has none.
  virtual const CorotationalShape* shape() const { return nullptr; }
  /// Forces on the nodes of the shape by the stress that it has at rest, in the block's frame; empty: none.
  virtual VectorXd initial_force(const BlockState&) const { return {}; }
  /// Number of its entries in BlockState::coordinates.
  virtual int n_coordinates() const { return 0; }
  virtual int n_unknowns() const = 0;
  virtual int n_stress_points() const = 0;
  /// Whether steps change what the state has of the block's stress.
  virtual bool changes_stress() const { return true; }
  int n_vertices() const { return n_vertices_; }
  int n_points() const { return static_cast<int>(reference_.size()); }
  /// Gives the block its number and the first of its entries in the arrays of the state.
  void number(int index, int first_point, int first_unknown, int first_stress_point, int first_coordinate);
  /// Range of the outline's vertices, the first of `points`.
  const Range& vertices() const { return vertices_; }
  /// Positions of the outline's vertices in a state, from the origin that the block has there.
  auto outline(const BlockState& state) const { return vertices_.columns_of(state.position); }
  const Range& points() const { return points_; }
  const Range& unknowns() const { return unknowns_; }
  const Range& stress_points() const { return stress_points_; }
  const Range& coordinates() const { return coordinates_; }

  /// The points at the start, relative to the model's origin.
  Eigen::Map<const Points> reference() const { return {reference_.front().data(), 2, n_points()}; }
  double reference_area() const { return reference_area_; }
  double mass_total() const { return material_.density * reference_area_; }
  /// The square root of the reference area: what tolerances are relative to.
  double size() const { return std::sqrt(reference_area_); }
  const BlockMaterial& material() const { return material_; }
  /// The multiple of a power of two nearest to a position: what the block's origin may be.
  Vec2 grid_point(const Vec2& near) const;

  /// Area moments of the outline; the centroid is relative to the block's origin.
  polyfem::AreaMoments moments(const BlockState& state) const {
    return polyfem::area_moments(outline(state));
  }
  /// Centroid of the outline, relative to the model's origin.
  Vec2 centroid(const BlockState& state) const { return state.origin.col(index_) + moments(state).centroid; }
  /// Momenta by unknown: M times velocities, one a column. M is density * integral of T^T T of (26).
  virtual MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const = 0;
  /// Mass matrix M, n_unknowns x n_unknowns.
  MatrixXd mass() const { return times_mass(MatrixXd::Identity(n_unknowns(), n_unknowns())); }
  /// Kinetic energy v M v / 2, J per m.
  virtual double kinetic_energy(const VectorIn& velocity) const {
    return velocity.dot(times_mass(velocity).col(0)) / 2;
  }
  /// Unknowns of a unit translation in x and in y: n_unknowns x 2.
  virtual const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const = 0;
  /// Writes the unknowns of a unit rotation about the centroid.
  virtual void rotation(const BlockState& state, Eigen::Ref<VectorXd> unknowns) const = 0;
  VectorXd rotation(const BlockState& state) const;
  /// The two translations and the rotation.
  RigidModes rigid_modes(const BlockState& state) const;
  /// The integration points (2 x n_stress_points) from the centroid, in the frame that stresses are kept in.
  virtual Points integration_points() const = 0;
  /// Area that belongs to each integration point.
  virtual const VectorXd& integration_weights() const = 0;
  /// 1 for an unknown that is a displacement, the block's size for one that is an angle or a strain: forces
  /// conjugate to it divided by this are comparable.
  virtual VectorXd unknown_lengths() const = 0;

  /// Moves the origin in `state` back to the block when it has gone far from it.
  void follow_with_origin(BlockState& state) const;

  /// Displacement of a point (0 .. n_points - 1) as a map of the unknowns.
  virtual PointMap vertex_map(int point) const = 0;
  /// Largest displacement of a vertex of the outline by d, or its speed by velocities; of all unknowns.
  double furthest_vertex(const VectorXd& d) const;
  /// F += integral of T^T b, Eq. (23), of all unknowns; `b` is a force per volume of the undeformed block.
  virtual void add_body_force(const Vec2& b, VectorXd& F) const = 0;

  /// Begins a step from a state. Throws Error when the block cannot be moved by the scheme.
  /// \param[in,out] step  an earlier one of this block, whose storage serves again, or null; valid while the
  ///                      block is
  virtual void begin_step(const BlockState& state, const StepStart& start,
                          std::unique_ptr<BlockStep>& step) const = 0;
  /// Number of parts of the tangent (BlockStep): it is a sum of matrices, each over some of the unknowns.
  virtual int n_parts() const { return 1; }
  /// Unknowns of a part, 0 .. n_unknowns - 1.
  virtual std::vector<int> part_unknowns(int part) const;

  /// Stress at the integration points, axes of the model, tension positive, 3 x n_stress_points, Pa.
  virtual Tensors stress(const BlockState& state) const = 0;
  /// Elastic energy: integral of sigma D^-1 sigma / 2, J per m.
  virtual double elastic_energy(const BlockState& state) const;
  /// The weights of the points (n_points) whose sum is x, a point of the closed block at the start.
  VectorXd point_weights(const Vec2& x) const;
  /// Displacements w of the outline vertices (2 x n, m, next to free of rigid motion) whose strains on the
  /// shape carry the stress: sigma(x) = D B(x) w, with Wachspress functions in B (8), is at
  /// every point x of the block the field nearest in energy to the stresses at the integration points. It is
  /// that field itself while the block has not turned, since the stress is then a sum of such fields.
  virtual Points strain_displacement(const BlockState& state) const = 0;

  /// The polygons that its stress is smooth in; they fill the block.
  virtual int n_cells() const { return 1; }
  virtual BlockCell cell(int c) const;
  virtual CellStress cell_stress(const BlockState& state, int c) const;

 protected:
  /// \param[in] points  the first `n_vertices` are the outline
  Block(const BlockMaterial& material, const PointsRef& points, int n_vertices);
  Block(const Block&) = default;

  Mat3 compliance() const;  ///< D^-1

 private:
  BlockMaterial material_;
  std::vector<Vec2> reference_;  ///< a matrix would take 64 bytes more
  double reference_area_;
  double grid_;  ///< spacing of the origins
  int index_ = 0;
  int n_vertices_;
  Range vertices_, points_, unknowns_, stress_points_, coordinates_;
};

/// The displacements about `centroid` of a uniform strain (xx, yy, gamma_xy), without rotation.
Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain);

}  // namespace ddacontact
