/// \file THE interface: one block of the system, whatever its unknowns.
#pragma once

#include <ddacontact/block/point_map.hpp>
#include <ddacontact/block/state.hpp>
#include <ddacontact/block/step_start.hpp>
#include <polyfem/basis/basis.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace ddacontact {

struct CorotationalShape;
class BlockMotion;

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
/// `number`. `prepare` makes the block ready for a state; `begin_step` for a step from there. Everything else
/// speaks of the state last prepared and the step last begun. Vectors of one block are in the order of its
/// own unknowns. Forces are per metre of thickness.
class Block {
 public:
  virtual ~Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

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

  /// Prepares the block for its outline in `state`.
  void prepare(const BlockState& state);

  /// Area moments of the outline; the centroid is relative to the block's origin.
  const polyfem::AreaMoments& moments() const { return moments_; }
  /// Centroid of the outline, relative to the model's origin.
  Vec2 centroid() const { return origin_ + moments_.centroid; }
  /// Momenta by unknown: M times velocities, one a column. M is density * integral of T^T T of (26).
  virtual MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const = 0;
  /// Mass matrix M, n_unknowns x n_unknowns.
  MatrixXd mass() const { return times_mass(MatrixXd::Identity(n_unknowns(), n_unknowns())); }
  /// Kinetic energy v M v / 2, J per m.
  virtual double kinetic_energy(const Eigen::Ref<const VectorXd>& velocity) const {
    return velocity.dot(times_mass(velocity).col(0)) / 2;
  }
  /// Unknowns of a unit translation in x and in y: n_unknowns x 2.
  virtual const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const = 0;
  /// Unknowns of a unit rotation about the centroid.
  Eigen::Map<const VectorXd> rotation() const {
    return {rotation_.data(), static_cast<Index>(rotation_.size())};
  }
  /// The two translations and the rotation.
  RigidModes rigid_modes() const;
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
  virtual void begin_step(const BlockState& state, const StepStart& start) = 0;
  /// Writes the displacements of a step without forces: where to look for those with them.
  virtual void free_path(Eigen::Ref<VectorXd> path) const = 0;
  /// The forces that resist displacements d of the block's unknowns.
  virtual void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const = 0;
  /// Number of parts of the tangent: the derivative of the forces by d, next to exact, symmetric positive
  /// definite, is a sum of matrices, each over some of the unknowns.
  virtual int n_parts() const { return 1; }
  /// Unknowns of a part, 0 .. n_unknowns - 1.
  virtual std::vector<int> part_unknowns(int part) const;
  /// The matrices of all parts.
  virtual void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const = 0;
  /// d += change, where the block's frame turns with it the rotation in `change` carried out as one:
  /// rotations that are added up stretch the block.
  virtual void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const {
    d += change;
  }
  /// Writes into `next`, which holds those before the step, the block's positions, velocity, what the scheme
  /// carries on and stress after it; with half steps the velocity is left as it is. `external` are all forces
  /// that acted on it, of its own unknowns: free blocks take their momentum from them (and with forces at the
  /// middle their angular momentum).
  virtual void end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external,
                        bool is_free, BlockState& next) const = 0;
  /// Displacements that the block's unknowns have after d. With half steps d is the straight motion of the
  /// shape at the start, dt times its velocities: forces act on that, and the block turns on the way.
  virtual void displacement(const Eigen::Ref<const VectorXd>& d, Eigen::Ref<VectorXd> displaced) const {
    displaced = d;
  }
  /// The step last begun, where blocks are carried on by their motions; none: they are not.
  virtual std::optional<BlockMotion> motion() const;

  /// Stress at the integration points, axes of the model, tension positive, 3 x n_stress_points, Pa.
  virtual Tensors stress(const BlockState& state) const = 0;
  /// Energy that the step's displacements d store in the block, J per m.
  virtual double stored_energy(const Eigen::Ref<const VectorXd>& d) const = 0;
  /// Work of the block's elastic forces that the step loses, J per m: by the identity of the scheme where
  /// there is one, so that a force that is not that of the energy leaves the ledger open; else the work of
  /// `elastic` less the energy stored.
  virtual double elastic_loss(const Eigen::Ref<const VectorXd>& d,
                              const Eigen::Ref<const VectorXd>& elastic) const {
    return d.dot(elastic) - stored_energy(d);
  }
  /// Elastic energy: integral of sigma D^-1 sigma / 2, J per m.
  virtual double elastic_energy(const BlockState& state) const;
  /// The weights of the points (n_points) whose sum is x, a point of the closed block at the start.
  VectorXd point_weights(const Vec2& x) const;
  /// Displacements w of the outline vertices (2 x n, m, next to free of rigid motion) whose strains on the
  /// shape last prepared carry the stress: sigma(x) = D B(x) w, with Wachspress functions in B (8), is at
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

  virtual void prepare_shape(const PointsRef& points) = 0;
  Mat3 compliance() const;  ///< D^-1

  /// Storage of rotation(), n_unknowns long, for prepare_shape to write.
  Eigen::Map<VectorXd> new_rotation() {
    rotation_.resize(n_unknowns());
    return {rotation_.data(), n_unknowns()};
  }

 private:
  BlockMaterial material_;
  // Not as matrices, which take 64 bytes more.
  std::vector<Vec2> reference_;
  std::vector<double> rotation_;
  double reference_area_;
  double grid_;  ///< spacing of the origins
  int index_ = 0;
  int n_vertices_;
  Range vertices_, points_, unknowns_, stress_points_, coordinates_;
  Vec2 origin_{0, 0};
  polyfem::AreaMoments moments_;
};

/// The displacements about `centroid` of a uniform strain (xx, yy, gamma_xy), without rotation.
Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain);

}  // namespace ddacontact
