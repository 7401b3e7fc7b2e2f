#include <ddacontact/block/corotational_block.hpp>

#include <ddacontact/block/stress_projection.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cassert>
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

CorotationalBlock::CorotationalBlock(const BlockMaterial& material, const PointsRef& places,
                                     std::shared_ptr<const CorotationalShape> shape)
    : Block(material, places, shape->n_outline), shape_(std::move(shape)), first_point_{0} {
  for (const ShapeCell& cell : shape_->cells)
    first_point_.push_back(first_point_.back() + static_cast<int>(cell.element.n_points()));
  integration_weights_.resize(n_stress_points());
  for (int c = 0; c < n_cells(); ++c)
    integration_weights_.segment(first_point_[c], first_point_[c + 1] - first_point_[c]) =
        shape_->cells[c].element.rule.weights;
  const Points shift = Vec2::UnitX() * shape_->translation.transpose();
  mass_of_translation_ = weighted(shift).row(0).transpose();
  mass_total_ = shape_->translation.dot(mass_of_translation_);
  map_places();
}

Points CorotationalBlock::nodes(const PointsRef& places) const {
  if (shape_->places.size() == 0) return places;
  return places * shape_->nodes_of_places.transpose();
}

Points CorotationalBlock::nodes(const BlockState& state) const {
  return nodes(state.position.middleCols(places().first, places().count));
}

Points CorotationalBlock::to_nodes(const Eigen::Ref<const VectorXd>& d) const {
  if (!shape_->has_basis()) return d.reshaped(2, d.size() / 2);
  return (shape_->basis * d).reshaped(2, shape_->nodes.cols());
}

VectorXd CorotationalBlock::to_unknowns(const Points& changes) const {
  if (!shape_->has_basis()) return interleaved(changes);
  return shape_->inverse_basis * interleaved(changes);
}

VectorXd CorotationalBlock::forces_on_unknowns(const Points& on_nodes) const {
  if (!shape_->has_basis()) return interleaved(on_nodes);
  return shape_->basis.transpose() * interleaved(on_nodes);
}

void CorotationalBlock::map_places() {
  if (shape_->places.size() == 0 && !shape_->has_basis()) return;
  const auto add = [&](Index node, double weight, std::vector<PointMap::Term>& terms) {
    for (int axis = 0; axis < 2; ++axis) {
      const Index row = 2 * node + axis;
      const Vec2 column = weight * Vec2::Unit(axis);
      if (!shape_->has_basis()) {
        add_term(static_cast<int>(row), column, terms);
        continue;
      }
      for (decltype(shape_->basis)::InnerIterator entry(shape_->basis, row); entry; ++entry)
        add_term(static_cast<int>(entry.col()), entry.value() * column, terms);
    }
  };
  place_maps_.resize(n_places());
  for (int place = 0; place < n_places(); ++place) {
    if (shape_->places.size() == 0) add(place, 1, place_maps_[place]);
    for (Index a = 0; a < shape_->places.cols(); ++a)
      if (shape_->places(place, a) != 0) add(a, shape_->places(place, a), place_maps_[place]);
  }
}

PointMap CorotationalBlock::vertex_map(int place) const {
  return place_maps_.empty() ? PointMap(unknowns().first + 2 * place)
                             : PointMap(unknowns().first, place_maps_[place]);
}

void CorotationalBlock::add_of_cell(const VectorXd& f, int c, Points& on_nodes) const {
  const std::vector<int>& of = shape_->cells[c].nodes;
  if (of.empty())
    on_nodes += f.reshaped(2, f.size() / 2);
  else
    for (std::size_t k = 0; k < of.size(); ++k)
      on_nodes.col(of[k]) += f.segment<2>(2 * static_cast<Index>(k));
}

Points CorotationalBlock::weighted(const Points& v) const {
  if (is_one_cell()) return v * shape_->cells[0].mass;
  return v * shape_->mass;
}

MatrixXd CorotationalBlock::times_mass(const Eigen::Ref<const MatrixXd>& velocities) const {
  MatrixXd momenta(n_unknowns(), velocities.cols());
  for (Index k = 0; k < velocities.cols(); ++k)
    momenta.col(k) = forces_on_unknowns(weighted(to_nodes(velocities.col(k))));
  return momenta;
}

void CorotationalBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  const Points on_nodes = b * mass_of_translation_.transpose() / material().density;
  F.segment(unknowns().first, unknowns().count) += forces_on_unknowns(on_nodes);
}

Points CorotationalBlock::spin(const Points& y) const {
  return quarter_turn() * (y - centre(y) * shape_->translation.transpose());
}

CorotationalBlock::Frame CorotationalBlock::cell_frame(const Points& y, int c) const {
  const ShapeCell& cell = shape_->cells[c];
  Frame frame;
  if (cell.nodes.empty())
    cell.elastic.frame(y, frame);
  else
    cell.elastic.frame(y(Eigen::all, cell.nodes), frame);
  return frame;
}

CorotationalBlock::Frames CorotationalBlock::frames(const Points& y) const {
  Frames frames;
  for (int c = 0; c < n_cells(); ++c) frames.cells.push_back(cell_frame(y, c));
  if (is_one_cell()) {
    frames.rotation = frames.cells[0].rotation;
    return frames;
  }
  const Mat2 F =
      y.leftCols(shape_->n_outline) * shape_->mean_gradient.leftCols(shape_->n_outline).transpose();
  const Vec2 turned = Vec2(F(0, 0) + F(1, 1), F(1, 0) - F(0, 1)).normalized();
  frames.rotation << turned.x(), -turned.y(), turned.y(), turned.x();
  return frames;
}

CorotationalBlock::Motion CorotationalBlock::split(const Points& y, const Points& velocity) const {
  const Points turning = spin(y);
  Motion motion;
  motion.linear = velocity * mass_of_translation_ / mass_total_;
  const Points momenta = weighted(turning);
  motion.angular = momenta.cwiseProduct(velocity).sum() / momenta.cwiseProduct(turning).sum();
  motion.deformation = velocity - motion.linear * shape_->translation.transpose() - motion.angular * turning;
  return motion;
}

Points CorotationalBlock::motion_at(const Points& y, const Motion& motion) const {
  return motion.linear * shape_->translation.transpose() + motion.angular * spin(y) + motion.deformation;
}

void CorotationalBlock::prepare_shape(const PointsRef& places) {
  const Points y = nodes(places), turning = spin(y);
  rigid_modes_.resize(n_unknowns(), 3);
  rigid_modes_.col(0) = to_unknowns(Vec2::UnitX() * shape_->translation.transpose());
  rigid_modes_.col(1) = to_unknowns(Vec2::UnitY() * shape_->translation.transpose());
  rigid_modes_.col(2) = to_unknowns(turning);
}

Tensors CorotationalBlock::initial_stress(const BlockState& state, int c) const {
  return state.stress.middleCols(stress_points().first + first_point_[c],
                                 first_point_[c + 1] - first_point_[c]);
}

void CorotationalBlock::begin_step(const BlockState& state, const StepStart& start) {
  const Range& u = unknowns();
  rule_ = start.rule;
  dt_ = start.dt;
  y0_ = nodes(state);
  velocity_ = to_nodes(start.velocity.segment(u.first, u.count));
  acceleration_ = to_nodes(start.acceleration.segment(u.first, u.count));
  jump_ = split(y0_, to_nodes(start.jump.segment(u.first, u.count)));
  jump_path_ = split(y0_, to_nodes(start.jump_path.segment(u.first, u.count)));
  start_ = frames(y0_);
  if (rule_.scheme == Scheme::decaying)
    deforming_ = start_.rotation.transpose() * split(y0_, velocity_).deformation;

  const double end_share = rule_.mean_forces() ? 0.5 + rule_.decay() : 1;
  initial_force_.resize(shape_->cells.size());
  reference_tangent_.resize(shape_->cells.size());
  for (int c = 0; c < n_cells(); ++c) {
    const ShapeCell& cell = shape_->cells[c];
    initial_force_[c].resize(2 * cell.elastic.n_nodes());
    polyfem::stress_forces(cell.element, initial_stress(state, c), initial_force_[c]);
    MatrixXd& A = reference_tangent_[c];
    A = (end_share + rule_.damping.stiffness / dt_) * cell.elastic.stiffness() +
        (rule_.inertia() / (dt_ * dt_) + rule_.damping.mass / dt_) * both_axes(cell.mass);
    if (rule_.scheme == Scheme::decaying && is_one_cell())
      A += (rigid_mass() - both_axes(cell.mass)) / (dt_ * dt_);
  }
}

VectorXd CorotationalBlock::free_path() const {
  const Motion motion = split(y0_, velocity_ + motion_at(y0_, jump_path_) / dt_);
  const Eigen::Rotation2Dd turn(2 * std::atan(dt_ * motion.angular / 2));
  const Points r = y0_ - centre(y0_) * shape_->translation.transpose();
  return to_unknowns(turn.toRotationMatrix() * r - r + dt_ * motion.linear * shape_->translation.transpose());
}

/// M Z (Z^T M Z)^-1 Z^T M of a reference shape of one cell.
MatrixXd CorotationalBlock::rigid_mass() const {
  Eigen::Matrix<double, Eigen::Dynamic, 3> Z(2 * shape_->nodes.cols(), 3);
  Z << interleaved(Vec2::UnitX() * shape_->translation.transpose()),
      interleaved(Vec2::UnitY() * shape_->translation.transpose()), interleaved(spin(shape_->nodes));
  const Eigen::Matrix<double, Eigen::Dynamic, 3> MZ = both_axes(shape_->cells[0].mass) * Z;
  return MZ * (Z.transpose() * MZ).diagonal().cwiseInverse().asDiagonal() * MZ.transpose();
}

void CorotationalBlock::elastic_force(const Frame& start, const Frame& end, int c,
                                      const VectorXd& initial_force, VectorXd& f) const {
  const polyfem::CorotatedElement& elastic = shape_->cells[c].elastic;
  if (rule_.mean_forces())
    elastic.mean_force(start, end, rule_.decay(), initial_force, f);
  else
    elastic.end_force(end, initial_force, f);
}

Points CorotationalBlock::path(const Points& step) const {
  return dt_ * velocity_ + motion_at(y0_ + step / 2, jump_path_);
}

Points CorotationalBlock::mean_deforming(const Points& step) const {
  return split(y0_ + step / 2, (step - motion_at(y0_ + step / 2, jump_path_)) / dt_).deformation;
}

Points CorotationalBlock::carried_deforming(const Frames& end) const {
  return polyfem::mid_rotation(start_.rotation, end.rotation) * deforming_;
}

Points CorotationalBlock::inertia_force(const Points& step, const Frames& end) const {
  Points acceleration = rule_.inertia() / (dt_ * dt_) * (step - path(step)) - rule_.history() * acceleration_;
  if (rule_.scheme == Scheme::decaying) acceleration -= (mean_deforming(step) - carried_deforming(end)) / dt_;
  return weighted(acceleration);
}

void CorotationalBlock::forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const {
  const Points step = to_nodes(d);
  const Frames end = frames(y0_ + step);
  Points elastic = Points::Zero(2, step.cols()), damping = rule_.damping.mass / dt_ * weighted(step);
  VectorXd f, damped;
  for (int c = 0; c < n_cells(); ++c) {
    const Frame &from = start_.cells[c], &to = end.cells[c];
    elastic_force(from, to, c, initial_force_[c], f);
    add_of_cell(f, c, elastic);
    if (rule_.damping.stiffness == 0) continue;
    const VectorXd rate = shape_->cells[c].elastic.stiffness() * (to.u - from.u);
    elastic_force(from, to, c, initial_force_[c] + rule_.damping.stiffness / dt_ * rate, damped);
    add_of_cell(damped - f, c, damping);
  }
  forces.elastic = forces_on_unknowns(elastic);
  forces.inertia = forces_on_unknowns(inertia_force(step, end));
  forces.damping = forces_on_unknowns(damping);
}

void CorotationalBlock::tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const {
  const Points y = y0_ + to_nodes(d);
  for (int c = 0; c < n_cells(); ++c) {
    const Mat2 end = cell_frame(y, c).rotation;
    polyfem::rotate(reference_tangent_[c],
                    rule_.mean_forces() ? polyfem::mid_rotation(start_.cells[c].rotation, end) : end,
                    parts[c]);
    const MatrixXd& B = shape_->cells[c].nodes_by_unknowns;
    if (B.size() > 0) parts[c] = (B.transpose() * parts[c] * B).eval();
  }
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
  const Range &u = unknowns(), &p = places();
  const Points step = to_nodes(d), y1 = y0_ + step;
  if (shape_->places.size() == 0)
    next.position.middleCols(p.first, p.count) = y1;
  else
    next.position.middleCols(p.first, p.count) = y1 * shape_->places.transpose();

  const Points acceleration =
      rule_.inertia() / (dt_ * dt_) * (step - path(step)) - rule_.history() * acceleration_;
  Points velocity = velocity_ + motion_at(y1, jump_) +
                    dt_ * ((1 - rule_.gamma) * acceleration_ + rule_.gamma * acceleration);
  if (rule_.scheme == Scheme::decaying) {
    // Rigid motion goes on, deformation has the velocity of the step's mean.
    const Motion trapezoid = split(y1, velocity);
    const Mat2 end = frames(y1).rotation,
               half_turn = end * polyfem::mid_rotation(start_.rotation, end).transpose();
    velocity += split(y1, half_turn * mean_deforming(step)).deformation - trapezoid.deformation;
  }
  next.acceleration.segment(u.first, u.count) = to_unknowns(acceleration);

  if (is_free) {
    // What the forces gave it, not what is left of it after K d has cancelled.
    const VectorXd acting = external - forces_on_unknowns(rule_.damping.mass / dt_ * weighted(step));
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
      const double inertia0 = weighted(turning0).cwiseProduct(turning0).sum(),
                   inertia = weighted(turning).cwiseProduct(turning).sum();
      const double torque = acting.dot(to_unknowns(spin(y0_ + step / 2)));
      const double angular = (inertia0 * before.angular + dt_ * torque) / inertia;
      velocity += (angular - end_motion.angular) * turning;
    }
  }
  next.velocity.segment(u.first, u.count) = to_unknowns(velocity);
  follow_with_origin(next);
}

double CorotationalBlock::stored_energy(const Eigen::Ref<const VectorXd>& d) const {
  const Frames end = frames(y0_ + to_nodes(d));
  double energy = 0;
  for (int c = 0; c < n_cells(); ++c) {
    const polyfem::CorotatedElement& elastic = shape_->cells[c].elastic;
    energy +=
        elastic.energy(end.cells[c], initial_force_[c]) - elastic.energy(start_.cells[c], initial_force_[c]);
  }
  return energy;
}

double CorotationalBlock::elastic_loss(const Eigen::Ref<const VectorXd>& d, const VectorXd& elastic) const {
  if (!rule_.mean_forces()) return Block::elastic_loss(d, elastic);
  if (rule_.decay() == 0) return 0;
  const Frames end = frames(y0_ + to_nodes(d));
  double loss = 0;
  for (int c = 0; c < n_cells(); ++c) {
    const VectorXd strained = end.cells[c].u - start_.cells[c].u;
    loss += rule_.decay() * strained.dot(shape_->cells[c].elastic.stiffness() * strained);
  }
  return loss;
}

double CorotationalBlock::elastic_energy(const BlockState& state) const {
  const Points y = nodes(state);
  double energy = 0;
  for (int c = 0; c < n_cells(); ++c) {
    const ShapeCell& cell = shape_->cells[c];
    const Tensors initial = initial_stress(state, c);
    VectorXd force(2 * cell.elastic.n_nodes());
    polyfem::stress_forces(cell.element, initial, force);
    energy +=
        cell.elastic.energy(cell_frame(y, c), force) +
        (initial.cwiseProduct(compliance() * initial).colwise().sum() * cell.element.rule.weights)(0) / 2;
  }
  return energy;
}

Tensors CorotationalBlock::cell_stresses(const BlockState& state, const Frame& frame, int c) const {
  const ShapeCell& cell = shape_->cells[c];
  Tensors stress;
  if (cell.mean_dilatation) {
    polyfem::b_bar_stresses(cell.element, material().elasticity, frame.u, stress);
  } else {
    Tensors strain;
    polyfem::strains(cell.element, frame.u, strain);
    stress = material().elasticity * strain;
  }
  return initial_stress(state, c) + stress;
}

Tensors CorotationalBlock::stress(const BlockState& state) const {
  const Points y = nodes(state);
  Tensors sigma(3, n_stress_points());
  for (int c = 0; c < n_cells(); ++c) {
    const Frame frame = cell_frame(y, c);
    const Tensors of_cell = cell_stresses(state, frame, c);
    for (Index q = 0; q < of_cell.cols(); ++q)
      sigma.col(first_point_[c] + q) = turned(frame.rotation, of_cell.col(q));
  }
  return sigma;
}

Points CorotationalBlock::integration_points() const {
  Points points(2, n_stress_points());
  for (int c = 0; c < n_cells(); ++c)
    points.middleCols(first_point_[c], first_point_[c + 1] - first_point_[c]) =
        shape_->cells[c].element.rule.points;
  return points;
}

BlockCell CorotationalBlock::cell(int c) const {
  const ShapeCell& of = shape_->cells[c];
  BlockCell cell = Block::cell(c);
  if (!of.nodes.empty()) cell.corners = of.nodes;
  cell.basis = of.basis;
  return cell;
}

CellStress CorotationalBlock::cell_stress(const BlockState& state, int c) const {
  if (is_one_cell()) return Block::cell_stress(state, c);
  const ShapeCell& cell = shape_->cells[c];
  const Frame frame = cell_frame(nodes(state), c);
  CellStress stress{frame.rotation * frame.u.reshaped(2, cell.elastic.n_nodes()), material().elasticity,
                    Vec3::Zero()};
  if (cell.mean_dilatation) stress.elasticity.topLeftCorner<2, 2>().array() -= material().elasticity(0, 1);
  // What the strains at the points do not carry is the same at all of them.
  Tensors strain;
  polyfem::strains(cell.element, frame.u, strain);
  const Tensors rest = cell_stresses(state, frame, c) - stress.elasticity * strain;
  stress.offset = turned(frame.rotation, rest.rowwise().mean());
  return stress;
}

Points CorotationalBlock::strain_displacement(const BlockState& state) const {
  assert(is_one_cell());
  const ShapeCell& cell = shape_->cells[0];
  const Frame frame = cell_frame(nodes(state), 0);
  const Points u = frame.u.reshaped(2, shape_->nodes.cols());
  Points w = u, rest = shape_->nodes;
  if (shape_->places.size() > 0) {
    w = u * shape_->places.transpose();
    rest = shape_->nodes * shape_->places.transpose();
  }
  const Tensors initial = initial_stress(state, 0);
  if (initial.isZero(0)) return frame.rotation * w;
  if (cell.element.n_points() == 1)
    w += uniform_strain_displacement(rest, Vec2::Zero(), compliance() * initial.col(0));
  else
    w += stress_projection(cell.element, cell.elastic.stiffness(), rest, initial, *cell.basis);
  return frame.rotation * w;
}

}  // namespace ddacontact
