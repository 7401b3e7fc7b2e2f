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

/// exp(D J / 2) for the turn D from start to end, in (-pi, pi].
Mat2 half_turn(const Mat2& start, const Mat2& end) {
  const Vec2 from = start.col(0), to = end.col(0);
  const double half = std::atan2(cross(from, to), from.dot(to)) / 2;
  return rotation_of(std::cos(half), std::sin(half));
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

void CorotatedElement::frame(const PointsRef& nodes, CorotatedFrame& frame) const {
  assert(nodes.cols() == n_nodes());
  const Vec2 shift = nodes * translation_;
  frame.local.resize(2, n_nodes());
  double A = 0, B = 0;
  for (Index a = 0; a < n_nodes(); ++a) {
    frame.local.col(a) = nodes.col(a) - translation_[a] * shift;
    A += weights_.col(a).dot(frame.local.col(a));
    B += cross(weights_.col(a), frame.local.col(a));
  }
  frame.stretch = std::hypot(A, B);
  frame.angle = std::atan2(B, A);
  frame.rotation = frame.stretch > 0 ? rotation_of(A / frame.stretch, B / frame.stretch) : rotation_of(1, 0);
  for (Index a = 0; a < n_nodes(); ++a) frame.local.col(a) = frame.rotation.transpose() * frame.local.col(a);
  frame.u = (frame.local - reference_).reshaped();
}

double CorotatedElement::energy(const CorotatedFrame& frame, const VectorXd& initial_force) const {
  double energy = initial_force.dot(frame.u);
  for (Index i = 0; i < 2 * n_nodes(); ++i) energy += frame.u[i] * K_.col(i).dot(frame.u) / 2;
  return energy;
}

void CorotatedElement::end_force(const CorotatedFrame& frame, const VectorXd& initial_force,
                                 VectorXd& f) const {
  mean_force(frame, frame, 0, initial_force, f);
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

void CorotatedElement::mean_force(const CorotatedFrame& start, const CorotatedFrame& end, double chi,
                                  const VectorXd& initial_force, VectorXd& f) const {
  assert(start.stretch > 0 && end.stretch > 0 && initial_force.size() == 2 * n_nodes());
  thread_local VectorXd u_w;
  u_w = (0.5 - chi) * start.u + (0.5 + chi) * end.u;
  f = initial_force;
  f.noalias() += K_ * u_w;

  const Mat2 half = half_turn(start.rotation, end.rotation), R_m = half * start.rotation;
  double moment = 0;  // about y_m
  for (Index a = 0; a < n_nodes(); ++a) {
    const Vec2 y_m = (half * end.local.col(a) + half.transpose() * start.local.col(a)) / 2;
    moment += cross(y_m, f.segment<2>(2 * a));
  }
  const double arm = (start.stretch + end.stretch) / 2;
  for (Index a = 0; a < n_nodes(); ++a) {
    const Vec2 couple = moment / arm * quarter_turn(weights_.col(a));
    f.segment<2>(2 * a) = R_m * (half(0, 0) * f.segment<2>(2 * a) - couple);
  }
}

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
