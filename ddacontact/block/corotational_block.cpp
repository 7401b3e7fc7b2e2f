#include <ddacontact/block/corotational_block.hpp>

#include <ddacontact/block/stress_projection.hpp>
#include <polyfem/element/matrices.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace ddacontact {

namespace {

Mat2 quarter_turn() {
  Mat2 J;
  J << 0, -1, 1, 0;
  return J;
}

VectorXd interleaved(const Points& p) {
  return p.reshaped();
}

/// A matrix of m nodes acting on x and y alike, 2m x 2m.
MatrixXd both_axes(const MatrixXd& M) {
  MatrixXd both = MatrixXd::Zero(2 * M.rows(), 2 * M.cols());
  for (Index a = 0; a < M.rows(); ++a)
    for (Index b = 0; b < M.cols(); ++b) both(2 * a, 2 * b) = both(2 * a + 1, 2 * b + 1) = M(a, b);
  return both;
}

/// Stress in axes turned by R: R sigma R^T.
Vec3 turned(const Mat2& R, const Vec3& stress) {
  Mat2 sigma;
  sigma << stress[0], stress[2], stress[2], stress[1];
  sigma = (R * sigma * R.transpose()).eval();
  return {sigma(0, 0), sigma(1, 1), sigma(0, 1)};
}

}  // namespace

CorotationalBlock::CorotationalBlock(const BlockMaterial& material, const PointsRef& outline,
                                     std::shared_ptr<const CorotationalShape> shape)
    : Block(material, outline),
      shape_(std::move(shape)),
      mass_of_translation_(shape_->mass * shape_->translation),
      mass_total_(shape_->translation.dot(mass_of_translation_)) {
  mass_ = both_axes(shape_->mass);
  if (shape_->basis.size() > 0) {
    inverse_basis_ = shape_->basis.inverse();
    mass_ = (shape_->basis.transpose() * mass_ * shape_->basis).eval();
  }
  integration_weights_ = shape_->element.rule.weights;
}

Points CorotationalBlock::to_nodes(const Eigen::Ref<const VectorXd>& d) const {
  if (shape_->basis.size() == 0) return d.reshaped(2, d.size() / 2);
  return (shape_->basis * d).reshaped(2, d.size() / 2);
}

VectorXd CorotationalBlock::to_unknowns(const Points& changes) const {
  if (shape_->basis.size() == 0) return interleaved(changes);
  return inverse_basis_ * interleaved(changes);
}

VectorXd CorotationalBlock::forces_on_unknowns(const Points& on_nodes) const {
  if (shape_->basis.size() == 0) return interleaved(on_nodes);
  return shape_->basis.transpose() * interleaved(on_nodes);
}

PointMap CorotationalBlock::vertex_map(int vertex) const {
  PointMap map;
  const int first = unknowns().first;
  if (shape_->basis.size() > 0) {
    for (Index u = 0; u < shape_->basis.cols(); ++u) {
      const Vec2 column =
          (shape_->outline.row(vertex) * shape_->basis.col(u).reshaped(2, shape_->nodes.cols()).transpose())
              .transpose();
      map.add(first + static_cast<int>(u), column);
    }
    return map;
  }
  for (Index a = 0; a < shape_->outline.cols(); ++a) {
    const double weight = shape_->outline(vertex, a);
    if (weight == 0) continue;
    map.add(first + 2 * static_cast<int>(a), weight * Vec2::UnitX());
    map.add(first + 2 * static_cast<int>(a) + 1, weight * Vec2::UnitY());
  }
  return map;
}

void CorotationalBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  const Points on_nodes = b * mass_of_translation_.transpose() / material().density;
  F.segment(unknowns().first, unknowns().count) += forces_on_unknowns(on_nodes);
}

Points CorotationalBlock::spin(const Points& y) const {
  return quarter_turn() * (y - centre(y) * shape_->translation.transpose());
}

CorotationalBlock::Motion CorotationalBlock::split(const Points& y, const Points& velocity) const {
  const Points turning = spin(y);
  Motion motion;
  motion.linear = velocity * mass_of_translation_ / mass_total_;
  motion.angular = (turning * shape_->mass).cwiseProduct(velocity).sum() /
                   (turning * shape_->mass).cwiseProduct(turning).sum();
  motion.deformation = velocity - motion.linear * shape_->translation.transpose() - motion.angular * turning;
  return motion;
}

Points CorotationalBlock::motion_at(const Points& y, const Motion& motion) const {
  return motion.linear * shape_->translation.transpose() + motion.angular * spin(y) + motion.deformation;
}

void CorotationalBlock::prepare_shape(const PointsRef& outline) {
  const Points y = nodes(outline), turning = spin(y);
  rigid_modes_.resize(n_unknowns(), 3);
  rigid_modes_.col(0) = to_unknowns(Vec2::UnitX() * shape_->translation.transpose());
  rigid_modes_.col(1) = to_unknowns(Vec2::UnitY() * shape_->translation.transpose());
  rigid_modes_.col(2) = to_unknowns(turning);
}

void CorotationalBlock::begin_step(const BlockState& state, const StepStart& start) {
  const Range& u = unknowns();
  rule_ = start.rule;
  dt_ = start.dt;
  y0_ = nodes(state.position.middleCols(vertices().first, vertices().count));
  velocity_ = to_nodes(start.velocity.segment(u.first, u.count));
  acceleration_ = to_nodes(start.acceleration.segment(u.first, u.count));
  jump_ = split(y0_, to_nodes(start.jump.segment(u.first, u.count)));
  jump_path_ = split(y0_, to_nodes(start.jump_path.segment(u.first, u.count)));
  shape_->elastic.frame(y0_, start_);
  initial_force_.resize(2 * y0_.cols());
  polyfem::stress_forces(
      shape_->element, state.stress.middleCols(stress_points().first, stress_points().count), initial_force_);

  const double end_share = rule_.mean_forces() ? 0.5 + rule_.decay() : 1;
  reference_tangent_ = (end_share + rule_.damping.stiffness / dt_) * shape_->elastic.stiffness() +
                       (rule_.inertia() / (dt_ * dt_) + rule_.damping.mass / dt_) * both_axes(shape_->mass);
  if (rule_.scheme == Scheme::decaying) {
    deforming_ = start_.rotation.transpose() * split(y0_, velocity_).deformation;
    reference_tangent_ += (rigid_mass() - both_axes(shape_->mass)) / (dt_ * dt_);
  }
}

VectorXd CorotationalBlock::free_path() const {
  const Motion motion = split(y0_, velocity_ + motion_at(y0_, jump_path_) / dt_);
  const Eigen::Rotation2Dd turn(2 * std::atan(dt_ * motion.angular / 2));
  const Points r = y0_ - centre(y0_) * shape_->translation.transpose();
  return to_unknowns(turn.toRotationMatrix() * r - r + dt_ * motion.linear * shape_->translation.transpose());
}

/// M Z (Z^T M Z)^-1 Z^T M of the reference shape.
MatrixXd CorotationalBlock::rigid_mass() const {
  Eigen::Matrix<double, Eigen::Dynamic, 3> Z(2 * shape_->nodes.cols(), 3);
  Z << interleaved(Vec2::UnitX() * shape_->translation.transpose()),
      interleaved(Vec2::UnitY() * shape_->translation.transpose()), interleaved(spin(shape_->nodes));
  const Eigen::Matrix<double, Eigen::Dynamic, 3> MZ = both_axes(shape_->mass) * Z;
  return MZ * (Z.transpose() * MZ).diagonal().cwiseInverse().asDiagonal() * MZ.transpose();
}

void CorotationalBlock::elastic_force(const Frame& end, const VectorXd& initial_force, VectorXd& f) const {
  if (rule_.mean_forces())
    shape_->elastic.mean_force(start_, end, rule_.decay(), initial_force, f);
  else
    shape_->elastic.end_force(end, initial_force, f);
}

Points CorotationalBlock::path(const Points& step) const {
  return dt_ * velocity_ + motion_at(y0_ + step / 2, jump_path_);
}

Points CorotationalBlock::mean_deforming(const Points& step) const {
  return split(y0_ + step / 2, (step - motion_at(y0_ + step / 2, jump_path_)) / dt_).deformation;
}

Points CorotationalBlock::carried_deforming(const Frame& end) const {
  return polyfem::mid_rotation(start_, end) * deforming_;
}

Points CorotationalBlock::inertia_force(const Points& step, const Frame& end) const {
  Points acceleration = rule_.inertia() / (dt_ * dt_) * (step - path(step)) - rule_.history() * acceleration_;
  if (rule_.scheme == Scheme::decaying) acceleration -= (mean_deforming(step) - carried_deforming(end)) / dt_;
  return acceleration * shape_->mass;
}

void CorotationalBlock::forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const {
  const Points step = to_nodes(d);
  Frame end;
  shape_->elastic.frame(y0_ + step, end);
  VectorXd f;
  elastic_force(end, initial_force_, f);
  forces.elastic = forces_on_unknowns(f.reshaped(2, step.cols()));
  forces.inertia = forces_on_unknowns(inertia_force(step, end));
  forces.damping = forces_on_unknowns(rule_.damping.mass / dt_ * step * shape_->mass);
  if (rule_.damping.stiffness > 0) {
    VectorXd damped;
    elastic_force(
        end,
        initial_force_ + rule_.damping.stiffness / dt_ * (shape_->elastic.stiffness() * (end.u - start_.u)),
        damped);
    forces.damping += forces_on_unknowns((damped - f).reshaped(2, step.cols()));
  }
}

void CorotationalBlock::tangent(const Eigen::Ref<const VectorXd>& d, MatrixXd& A) const {
  Frame end;
  shape_->elastic.frame(y0_ + to_nodes(d), end);
  polyfem::rotate(reference_tangent_, rule_.mean_forces() ? polyfem::mid_rotation(start_, end) : end.rotation,
                  A);
  if (shape_->basis.size() > 0) A = (shape_->basis.transpose() * A * shape_->basis).eval();
}

void CorotationalBlock::add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const {
  const Points y = y0_ + to_nodes(d);
  const Motion motion = split(y, to_nodes(change));
  const Mat2 turn = Eigen::Rotation2Dd(motion.angular).toRotationMatrix() - Mat2::Identity();
  const Points arms = y - centre(y) * shape_->translation.transpose() + motion.deformation;
  d += to_unknowns(turn * arms + motion.deformation + motion.linear * shape_->translation.transpose());
}

void CorotationalBlock::end_step(const Eigen::Ref<const VectorXd>& d,
                                 const Eigen::Ref<const VectorXd>& external, bool is_free,
                                 BlockState& next) const {
  const Range &u = unknowns(), &v = vertices();
  const Points step = to_nodes(d), y1 = y0_ + step;
  next.position.middleCols(v.first, v.count) = y1 * shape_->outline.transpose();
  Frame end;
  shape_->elastic.frame(y1, end);

  const Points acceleration =
      rule_.inertia() / (dt_ * dt_) * (step - path(step)) - rule_.history() * acceleration_;
  Points velocity = velocity_ + motion_at(y1, jump_) +
                    dt_ * ((1 - rule_.gamma) * acceleration_ + rule_.gamma * acceleration);
  if (rule_.scheme == Scheme::decaying) {
    // Rigid motion goes on, deformation has the velocity of the step's mean.
    const Motion trapezoid = split(y1, velocity);
    const Mat2 half_turn = end.rotation * polyfem::mid_rotation(start_, end).transpose();
    velocity += split(y1, half_turn * mean_deforming(step)).deformation - trapezoid.deformation;
  }
  next.acceleration.segment(u.first, u.count) = to_unknowns(acceleration);

  if (is_free) {
    // What the forces gave it, not what is left of it after K d has cancelled.
    const VectorXd acting = external - forces_on_unknowns(rule_.damping.mass / dt_ * step * shape_->mass);
    const Vec2 force(acting.dot(rigid_modes_.col(0)), acting.dot(rigid_modes_.col(1)));
    const Motion before = split(y0_, velocity_ + motion_at(y0_, jump_)), end_motion = split(y1, velocity);
    const Vec2 start_acceleration = acceleration_ * mass_of_translation_ / mass_total_;
    const Vec2 linear =
        before.linear + dt_ * ((1 - rule_.gamma) * start_acceleration + rule_.gamma * (force / mass_total_));
    velocity += (linear - end_motion.linear) * shape_->translation.transpose();
    if (rule_.history() != 0) {
      Points kept = to_nodes(next.acceleration.segment(u.first, u.count));
      kept +=
          (force / mass_total_ - kept * mass_of_translation_ / mass_total_) * shape_->translation.transpose();
      next.acceleration.segment(u.first, u.count) = to_unknowns(kept);
    }
    if (rule_.mean_forces()) {
      const Points turning0 = spin(y0_), turning = spin(y1);
      const double inertia0 = (turning0 * shape_->mass).cwiseProduct(turning0).sum(),
                   inertia = (turning * shape_->mass).cwiseProduct(turning).sum();
      const double torque = acting.dot(to_unknowns(spin(y0_ + step / 2)));
      const double angular = (inertia0 * before.angular + dt_ * torque) / inertia;
      velocity += (angular - end_motion.angular) * turning;
    }
  }
  next.velocity.segment(u.first, u.count) = to_unknowns(velocity);
  follow_with_origin(next);
}

double CorotationalBlock::stored_energy(const Eigen::Ref<const VectorXd>& d) const {
  Frame end;
  shape_->elastic.frame(y0_ + to_nodes(d), end);
  return shape_->elastic.energy(end, initial_force_) - shape_->elastic.energy(start_, initial_force_);
}

double CorotationalBlock::elastic_loss(const Eigen::Ref<const VectorXd>& d, const VectorXd& elastic) const {
  if (!rule_.mean_forces()) return Block::elastic_loss(d, elastic);
  Frame end;
  shape_->elastic.frame(y0_ + to_nodes(d), end);
  const VectorXd strained = end.u - start_.u;
  return rule_.decay() * strained.dot(shape_->elastic.stiffness() * strained);
}

Tensors CorotationalBlock::stress(const BlockState& state) const {
  Frame frame;
  shape_->elastic.frame(nodes(state.position.middleCols(vertices().first, vertices().count)), frame);
  Tensors strain;
  polyfem::strains(shape_->element, frame.u, strain);
  Tensors sigma = state.stress.middleCols(stress_points().first, stress_points().count);
  sigma += material().elasticity * strain;
  for (Index q = 0; q < sigma.cols(); ++q) sigma.col(q) = turned(frame.rotation, sigma.col(q));
  return sigma;
}

Points CorotationalBlock::strain_displacement(const BlockState& state) const {
  const auto outline = state.position.middleCols(vertices().first, vertices().count);
  Frame frame;
  shape_->elastic.frame(nodes(outline), frame);
  Points w = frame.u.reshaped(2, shape_->nodes.cols()) * shape_->outline.transpose();
  const auto initial = state.stress.middleCols(stress_points().first, stress_points().count);
  if (initial.isZero(0)) return frame.rotation * w;
  const Points rest = shape_->nodes * shape_->outline.transpose();
  if (shape_->element.n_points() == 1)
    w += uniform_strain_displacement(rest, Vec2::Zero(), compliance() * initial.col(0));
  else
    w += stress_projection(shape_->element, shape_->elastic.stiffness(), rest, initial);
  return frame.rotation * w;
}

}  // namespace ddacontact
