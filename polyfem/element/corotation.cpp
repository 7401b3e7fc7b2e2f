#include <polyfem/element/corotation.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cassert>
#include <cmath>

namespace polyfem {
namespace {

/// J a
Vec2 quarter_turn(const Vec2& a) {
  return {-a.y(), a.x()};
}

/// The rotation with these cosine and sine.
Mat2 rotation_of(double cosine, double sine) {
  Mat2 R;
  R << cosine, -sine, sine, cosine;
  return R;
}

/// The rotation along (A, B), of length s.
Mat2 rotation_by(const Vec2& AB, double s) {
  return s > 0 ? rotation_of(AB[0] / s, AB[1] / s) : rotation_of(1, 0);
}

/// exp(D J / 2) for the turn D from start to end, in (-pi, pi].
Mat2 half_turn(const Mat2& start, const Mat2& end) {
  const Vec2 from = start.col(0), to = end.col(0);
  const double cosine = from.dot(to), sine = cross(from, to);
  if (cosine >= 0) {
    const double half = std::sqrt((1 + cosine) / 2);
    return rotation_of(half, sine / (2 * half));
  }
  const double half = std::copysign(std::sqrt((1 - cosine) / 2), sine);
  return rotation_of(sine / (2 * half), half);
}

/// The numbers of a vector or a matrix of a known number of nodes.
template <class Sized>
Eigen::Map<const Sized, Eigen::Aligned16> as(const auto& numbers) {
  return {numbers.data(), numbers.rows(), numbers.cols()};
}

}  // namespace

Mat2 mid_rotation(const Mat2& start, const Mat2& end) {
  return half_turn(start, end) * start;
}

CorotatedElement::CorotatedElement(const PointsRef& reference, const PointsRef& weights,
                                   const VectorXd& translation, const MatrixXd& stiffness)
    : reference_(reference),
      weights_(weights),
      translation_(translation / translation.norm()),
      K_(stiffness) {
  assert(weights_.cols() == n_nodes() && K_.rows() == 2 * n_nodes() && K_.cols() == 2 * n_nodes());
  reference_ -= reference_ * translation_ * translation_.transpose();
  assert((reference_ * weights_.transpose()).isIdentity(1e-6));
}

CorotatedElement::CorotatedElement(const PointsRef& reference, const PointsRef& weights,
                                   const MatrixXd& stiffness)
    : CorotatedElement(reference, weights, VectorXd::Ones(reference.cols()), stiffness) {}

template <class Of>
Vec2 CorotatedElement::sums(const Eigen::Ref<const typename Of::Vectors>& nodes,
                            typename Of::Vectors& centred) const {
  assert(nodes.cols() == n_nodes());
  const auto weights = as<typename Of::Vectors>(weights_);
  const auto translation = as<typename Of::Scalars>(translation_);
  const Vec2 shift = nodes.lazyProduct(translation);
  centred.resize(2, nodes.cols());
  double A = 0, B = 0;
  for (Index a = 0; a < nodes.cols(); ++a) {
    centred.col(a) = nodes.col(a) - translation[a] * shift;
    A += weights.col(a).dot(centred.col(a));
    B += cross(weights.col(a), centred.col(a));
  }
  return {A, B};
}

template <class Of>
void CorotatedElement::frame(const Eigen::Ref<const typename Of::Vectors>& nodes,
                             CorotatedFrameOf<Of>& frame) const {
  const Vec2 AB = sums<Of>(nodes, frame.local);
  frame.stretch = AB.norm();
  frame.rotation = rotation_by(AB, frame.stretch);
  for (Index a = 0; a < nodes.cols(); ++a)
    frame.local.col(a) = frame.rotation.transpose() * frame.local.col(a);
  complete(frame);
}

template <class Of>
void CorotatedElement::complete(CorotatedFrameOf<Of>& frame) const {
  frame.u = (frame.local - as<typename Of::Vectors>(reference_)).reshaped();
}

template <class Of>
Mat2 CorotatedElement::rotation(const typename Of::Vectors& nodes) const {
  typename Of::Vectors centred;
  const Vec2 AB = sums<Of>(nodes, centred);
  return rotation_by(AB, AB.norm());
}

template <class Of>
typename Of::Stacked CorotatedElement::times_stiffness(const typename Of::Stacked& u) const {
  typename Of::Stacked Ku = Of::Stacked::Zero(u.size());
  for (Index i = 0; i < u.size(); ++i)
    Ku += u[i] * Eigen::Map<const typename Of::Stacked, Eigen::Aligned16>(K_.col(i).data(), u.size());
  return Ku;
}

template <class Of>
double CorotatedElement::energy(const CorotatedFrameOf<Of>& frame,
                                const Eigen::Ref<const typename Of::Stacked>& initial_force) const {
  return initial_force.dot(frame.u) + frame.u.dot(times_stiffness<Of>(frame.u)) / 2;
}

void CorotatedElement::end_tangent(const CorotatedFrame& frame, const VectorXd& initial_force,
                                   MatrixXd& tangent) const {
  assert(frame.stretch > 0);
  const double s = frame.stretch;
  const Mat2 J = rotation_of(0, 1);
  const VectorXd alpha = weights_.reshaped(), beta = (J * weights_).reshaped();
  const VectorXd y = frame.local.reshaped(), Jy = (J * frame.local).reshaped();
  const VectorXd g = K_ * frame.u + initial_force, Jg = (J * g.reshaped(2, n_nodes())).reshaped();
  const VectorXd KJy = K_ * Jy;
  const VectorXd v = (Jg - KJy + (g.dot(Jy) * alpha + (KJy.dot(Jy) - g.dot(y)) / 2 * beta) / s) / s;
  tangent = K_;
  tangent.noalias() += v * beta.transpose();
  tangent.noalias() += beta * v.transpose();
  rotate(tangent, frame.rotation, tangent);
}

template <class Of>
void CorotatedElement::mean_force(const CorotatedFrameOf<Of>& start, const CorotatedFrameOf<Of>& end,
                                  double chi, const Eigen::Ref<const typename Of::Stacked>& initial_force,
                                  typename Of::Stacked& f) const {
  assert(start.stretch > 0 && end.stretch > 0 && initial_force.size() == 2 * n_nodes());
  f = initial_force + times_stiffness<Of>((0.5 - chi) * start.u + (0.5 + chi) * end.u);

  const auto weights = as<typename Of::Vectors>(weights_);
  const Mat2 half = half_turn(start.rotation, end.rotation), R_m = half * start.rotation;
  double moment = 0;  // about y_m
  for (Index a = 0; a < weights.cols(); ++a) {
    const Vec2 y_m = (half * end.local.col(a) + half.transpose() * start.local.col(a)) / 2;
    moment += cross(y_m, f.template segment<2>(2 * a));
  }
  const double arm = (start.stretch + end.stretch) / 2;
  for (Index a = 0; a < weights.cols(); ++a) {
    const Vec2 couple = moment / arm * quarter_turn(weights.col(a));
    f.template segment<2>(2 * a) = R_m * (half(0, 0) * f.template segment<2>(2 * a) - couple);
  }
}

#define POLYFEM_FOR_NODES(Of)                                                                               \
  template void CorotatedElement::frame(const Eigen::Ref<const Of::Vectors>&, CorotatedFrameOf<Of>&) const; \
  template void CorotatedElement::complete(CorotatedFrameOf<Of>&) const;                                    \
  template Mat2 CorotatedElement::rotation<Of>(const Of::Vectors&) const;                                   \
  template Of::Stacked CorotatedElement::times_stiffness<Of>(const Of::Stacked&) const;                     \
  template double CorotatedElement::energy(const CorotatedFrameOf<Of>&,                                     \
                                           const Eigen::Ref<const Of::Stacked>&) const;                     \
  template void CorotatedElement::mean_force(const CorotatedFrameOf<Of>&, const CorotatedFrameOf<Of>&,      \
                                             double, const Eigen::Ref<const Of::Stacked>&, Of::Stacked&)    \
      const;
POLYFEM_FOR_NODES(FourNodes)
POLYFEM_FOR_NODES(FewNodes)
POLYFEM_FOR_NODES(AnyNodes)
#undef POLYFEM_FOR_NODES

Points mean_gradient_weights(const PointsRef& polygon) {
  Points weights(2, polygon.cols());
  const double area = signed_area(polygon);
  for (Index a = 0; a < polygon.cols(); ++a) weights.col(a) = boundary_integral(polygon, a) / area;
  return weights;
}

void rotate(const MatrixXd& A, const Mat2& R, MatrixXd& out) {
  out.resize(A.rows(), A.cols());
  for (Index j = 0; j < A.cols(); j += 2)
    for (Index i = 0; i < A.rows(); i += 2) {
      const Mat2 block = A.block<2, 2>(i, j);
      out.block<2, 2>(i, j).noalias() = R * block * R.transpose();
    }
}

}  // namespace polyfem
