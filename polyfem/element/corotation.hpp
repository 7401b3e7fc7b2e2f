/// \file An elastic element that turns: small strains, any rotation, any number of nodes.
///
/// The element's frame is the polar rotation R of its mean deformation gradient F = sum_a y_a b_a^T, with
/// R = exp(theta J) and J a quarter turn to the left: theta = atan2(B(y), A(y)) of the linear forms
/// A(z) = tr sum_a z_a b_a^T and B(z) = sum_a J b_a . z_a. What is left of the motion, u = R^T y - Y, strains
/// the element as in small displacements: E = u.Ku / 2 + f0.u. A homogeneous deformation F = R U gives the
/// Biot strain U - 1 in a polygon of any shape.
///
/// With s = hypot(A(y), B(y)), a change of place dy changes u by P R^T dy, P z = z - (B(z) / s) J R^T y.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Arrays of 2-vectors, one a node: as columns, and stacked (u1 v1 u2 v2 ...). Of any number of nodes; of N;
/// or of at most `Most`, which like N live without the heap.
template <int N, int Most = N>
struct Nodal {
  static constexpr int twice(int n) { return n == Eigen::Dynamic ? n : 2 * n; }
  using Vectors = Eigen::Matrix<double, 2, N, Eigen::ColMajor, 2, Most>;
  using Stacked = Eigen::Matrix<double, twice(N), 1, Eigen::ColMajor, twice(Most), 1>;
  using Scalars = Eigen::Matrix<double, N, 1, Eigen::ColMajor, Most, 1>;
  using Square = Eigen::Matrix<double, N, N, Eigen::ColMajor, Most, Most>;  ///< of one axis
};
/// Arrays of quadrilaterals.
using FourNodes = Nodal<4>;
/// Arrays of up to 16 nodes, without the heap.
using FewNodes = Nodal<Eigen::Dynamic, 16>;
/// Arrays of any number of nodes.
using AnyNodes = Nodal<Eigen::Dynamic>;

/// Where an element is: the frame that turns with it and its displacement seen from there.
template <class Of>
struct CorotatedFrameOf {
  /// s, the trace of U in F = R U: 2 without strain, the difference of the principal stretches where the
  /// element is inside out. Where it is 0 (collapsed, or a plain mirror image) no rotation is nearest: R is 1
  /// and there are no forces; near 0 they mean nothing.
  double stretch = 0;
  Mat2 rotation = Mat2::Identity();  ///< R
  typename Of::Vectors local;        ///< R^T y from the element's centre, 2 x m
  typename Of::Stacked u;            ///< local displacements from centre to centre (u1 v1 u2 v2 ...), 2m
};
/// The same for any number of nodes.
using CorotatedFrame = CorotatedFrameOf<AnyNodes>;

/// The rotation exp(D J / 2) R_start half way to the end, where D in (-pi, pi] is the turn between them.
Mat2 mid_rotation(const Mat2& start, const Mat2& end);

/// The stiffness of one element and the frame that it is carried in. Forces are 2m entries as u is, along the
/// fixed axes; they have no resultant, and no moment about the shape that they act on. What is a template is
/// there for FourNodes, FewNodes and AnyNodes.
class CorotatedElement {
 public:
  /// Nodes at rest (2 x m), the weights b of F (2 x m, sum_a Y_a b_a^T = 1) and the symmetric K (2m x 2m),
  /// zero for small rigid motions. `translation` tells by how much each node moves (m entries) when the
  /// element is shifted by 1: all the same for points; 1, 0, 0 for a centre and the two columns of F. Such a
  /// shift must change neither F nor the energy of f0.
  CorotatedElement(const PointsRef& reference, const PointsRef& weights, const VectorXd& translation,
                   const MatrixXd& stiffness);
  /// The same for points.
  CorotatedElement(const PointsRef& reference, const PointsRef& weights, const MatrixXd& stiffness);

  Index n_nodes() const { return reference_.cols(); }
  const MatrixXd& stiffness() const { return K_; }

  /// The frame of nodes at y (2 x m), whose round-off is that of y: give them from an origin nearby. The
  /// common translation is taken out of u, as large ones would leave K u a resultant of their round-off.
  /// Where positions may be collapsed or mirrored, check the stretch before
  /// forces are requested.
  template <class Of>
  void frame(const Eigen::Ref<const typename Of::Vectors>& nodes, CorotatedFrameOf<Of>& frame) const;
  /// The rest of a frame whose stretch, rotation and local positions are known.
  template <class Of>
  void complete(CorotatedFrameOf<Of>& frame) const;
  /// The rotation of the frame of nodes at y alone.
  template <class Of>
  Mat2 rotation(const typename Of::Vectors& nodes) const;

  /// E = u.Ku / 2 + f0.u per unit thickness. f0: the nodal forces of an initial stress in the rest shape.
  template <class Of>
  double energy(const CorotatedFrameOf<Of>& frame,
                const Eigen::Ref<const typename Of::Stacked>& initial_force) const;
  /// K u, the entries of u being those of a frame.
  template <class Of>
  typename Of::Stacked times_stiffness(const typename Of::Stacked& u) const;

  /// f = R P^T (K u + f0), the gradient of E. Asserts a stretch above 0.
  template <class Of>
  void end_force(const CorotatedFrameOf<Of>& frame,
                 const Eigen::Ref<const typename Of::Stacked>& initial_force, typename Of::Stacked& f) const {
    mean_force(frame, frame, 0, initial_force, f);
  }

  /// The gradient of `end_force`, symmetric: R (K + v beta^T + beta v^T) R^T with B(z) = beta.z. R K R^T
  /// (see `rotate`) leaves out v, which is of the order of the strain times K.
  void end_tangent(const CorotatedFrame& frame, const VectorXd& initial_force, MatrixXd& tangent) const;

  /// The force of a step, a discrete gradient: with chi = 0, f.(y1 - y0) = E1 - E0 to round-off for any step
  /// that turns by less than pi; chi = 1/2 dissipates (u1 - u0).K(u1 - u0) / 2. f = R_m P_m^T (K u_w + f0),
  /// u_w = (1/2 - chi) u0 + (1/2 + chi) u1, acting on the shape y_m = R_m^T (y0 + y1) / 2:
  /// P_m z = cos(D / 2) z - 2 B(z) / (s0 + s1) J y_m, for which P_m R_m^T (y1 - y0) = u1 - u0.
  /// (1/2 + chi) R_m K R_m^T is its gradient but for terms of the order of the strain and of D.
  template <class Of>
  void mean_force(const CorotatedFrameOf<Of>& start, const CorotatedFrameOf<Of>& end, double chi,
                  const Eigen::Ref<const typename Of::Stacked>& initial_force, typename Of::Stacked& f) const;

 private:
  /// The nodes from the element's centre, and the sums A(y) and B(y) over them.
  template <class Of>
  Vec2 sums(const Eigen::Ref<const typename Of::Vectors>& nodes, typename Of::Vectors& centred) const;

  Points reference_, weights_;
  VectorXd translation_;
  MatrixXd K_;
};

/// The weights b_a that make sum_a y_a b_a^T the mean over a polygon of the gradient of any interpolation
/// linear on its edges: boundary integrals over the area, 1/m.
Points mean_gradient_weights(const PointsRef& polygon);

/// R A R^T for each 2 x 2 block of A, a matrix of the rest shape turned with the element. `out` may be A.
void rotate(const MatrixXd& A, const Mat2& R, MatrixXd& out);

}  // namespace polyfem
