/// \file THE interface: one block of the system, whatever its unknowns.
#pragma once

#include <ddacontact/block/point_map.hpp>
#include <ddacontact/block/state.hpp>
#include <polyfem/geometry/area_moments.hpp>

namespace ddacontact {

/// What a block is made of.
struct BlockMaterial {
  Mat3 elasticity;     ///< D of (9), Pa
  double density = 0;  ///< at the start, kg/m3
};

/// One block of (13): its matrices on its current shape, and how its unknowns move its outline.
///
/// Unknowns, outline vertices and integration points are ranges of the arrays of BlockState, given once by
/// `place`. The paper's scheme is incremental: `prepare` computes everything on the shape of a state; all
/// other functions speak of the shape last prepared. Forces are per metre of thickness.
class Block {
 public:
  virtual ~Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  virtual int n_unknowns() const = 0;
  virtual int n_stress_points() const = 0;
  int n_vertices() const { return static_cast<int>(reference_.cols()); }
  /// Where this block's entries start in the arrays of the state.
  void place(int first_vertex, int first_unknown, int first_stress_point);
  const Range& vertices() const { return vertices_; }
  const Range& unknowns() const { return unknowns_; }
  const Range& stress_points() const { return stress_points_; }

  /// At the start.
  const Points& reference() const { return reference_; }
  double reference_area() const { return reference_area_; }
  double mass_total() const { return material_.density * reference_area_; }
  /// The square root of the reference area: what tolerances are relative to.
  double size() const;

  /// Computes the quantities below on the block's outline in `state`.
  void prepare(const BlockState& state);

  const polyfem::AreaMoments& moments() const { return moments_; }
  /// K of (17), n_unknowns x n_unknowns.
  const MatrixXd& stiffness() const { return stiffness_; }
  /// The mass matrix, density * integral of T^T T of (26). The density is scaled by reference over current
  /// area, so that a block that inflates makes no mass.
  const MatrixXd& mass() const { return mass_; }
  /// Unknowns of a unit translation in x, in y and a unit rotation about the centroid: n_unknowns x 3.
  const Eigen::Matrix<double, Eigen::Dynamic, 3>& rigid_modes() const { return rigid_modes_; }
  /// Area that belongs to each integration point.
  const VectorXd& integration_weights() const { return integration_weights_; }
  /// 1 for an unknown that is a displacement, the block's size for one that is an angle or a strain: forces
  /// conjugate to it divided by this are comparable.
  virtual VectorXd unknown_lengths() const = 0;

  /// The displacement of outline vertex `vertex` (0 .. n_vertices - 1).
  virtual PointMap vertex_map(int vertex) const = 0;
  /// F -= integral of B^T sigma, Eq. (19).
  virtual void add_stress_forces(const BlockState& state, VectorXd& F) const = 0;
  /// F += integral of T^T b, Eq. (23); `b` is a force per volume of the undeformed block.
  virtual void add_body_force(const Vec2& b, VectorXd& F) const = 0;
  /// Adds the stress that the step's displacements d make, Eq. (8), (9), (12).
  virtual void add_stress(const VectorXd& d, Tensors& stress) const = 0;

  /// Displacements w of the outline vertices (2 x n, m, next to free of rigid motion) whose strains on the shape last
  /// prepared carry the stress: sigma(x) = D B(x) w, with Wachspress functions in B (8), is at every point x
  /// of the block the field nearest in energy to the stresses at the integration points. It is that field
  /// itself while the block has not turned, since the stress is then a sum of such fields.
  virtual Points strain_displacement(const BlockState& state) const = 0;

  const BlockMaterial& material() const { return material_; }

  /// Integral of sigma D^-1 sigma / 2 over the shape last prepared, J per m.
  double elastic_energy(const BlockState& state) const;

 protected:
  Block(const BlockMaterial& material, const PointsRef& outline);

  virtual void prepare_shape(const PointsRef& outline) = 0;
  const Mat3& compliance() const { return compliance_; }  ///< D^-1
  double current_density() const { return material_.density * reference_area_ / moments_.area; }

  MatrixXd stiffness_, mass_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> rigid_modes_;
  VectorXd integration_weights_;

 private:
  BlockMaterial material_;
  Mat3 compliance_;
  Points reference_;
  double reference_area_;
  Range vertices_, unknowns_, stress_points_;
  polyfem::AreaMoments moments_;
};

/// The displacements about `centroid` of a uniform strain (xx, yy, gamma_xy), without rotation.
Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain);

}  // namespace ddacontact
