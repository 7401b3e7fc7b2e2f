#include <ddacontact/block/block_system.hpp>

#include <ddacontact/block/corotational_motion.hpp>
#include <ddacontact/core/for_all.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace ddacontact {

BlockSystem::BlockSystem(std::vector<std::unique_ptr<Block>> blocks) {
  int n_points = 0;
  names.reserve(blocks.size());
  blocks_.reserve(blocks.size());
  for (std::unique_ptr<Block>& block : blocks) {
    block->number(n_blocks(), n_points, n_unknowns_, n_stress_points_, n_coordinates_);
    n_points = block->points().end();
    n_unknowns_ = block->unknowns().end();
    n_stress_points_ = block->stress_points().end();
    n_coordinates_ = block->coordinates().end();
    names.push_back(std::to_string(n_blocks()));
    blocks_.push_back(std::move(block));
  }
  block_of_point_.reserve(static_cast<std::size_t>(n_points));
  for (int b = 0; b < n_blocks(); ++b) block_of_point_.insert(block_of_point_.end(), block(b).n_points(), b);
  const BlockState initial = initial_state();
  start_.position = initial.position;
  start_.origin = initial.origin;
  present_.assign(blocks_.size(), true);
  resting_.assign(blocks_.size(), false);
  number_equations();
}

Points BlockSystem::reference() const {
  Points points(2, static_cast<Index>(block_of_point_.size()));
  for (const auto& block : blocks_) block->points().columns_of(points) = block->reference();
  return points;
}

void BlockSystem::round_corners(double ratio) {
  rounded_.clear();
  for (int b = 0; ratio > 0 && b < n_blocks(); ++b) {
    const Points outline = block(b).reference().leftCols(block(b).n_vertices());
    const double wanted = ratio * block(b).size(), fits = largest_rounding(outline).radius;
    rounded_.push_back(ddacontact::round_corners(outline, wanted < fits ? wanted : fits / 2));
  }
}

int BlockSystem::block_of_unknown(int unknown) const {
  assert(unknown >= 0 && unknown < n_unknowns_);
  const auto end = [](const auto& of) { return of->unknowns().end(); };
  return static_cast<int>(std::ranges::upper_bound(blocks_, unknown, {}, end) - blocks_.begin());
}

double BlockSystem::corner_radius(int b, int other) const {
  return is_movable(other) ? std::min(rounded_[b].radius, rounded_[other].radius) : rounded_[b].radius;
}

void BlockSystem::set_bolts(std::vector<Bolt> all) {
  bolts = std::move(all);
  int first = 0;
  for (Bolt& bolt : bolts) {
    bolt.numbers = {first, bolt.n_numbers()};
    first = bolt.numbers.end();
  }
}

void BlockSystem::set_prescribed_dofs(std::vector<PrescribedDof> held) {
  prescribed_dofs_ = std::move(held);
  number_equations();
}

void BlockSystem::remove(int b) {
  present_[b] = false;
  TakenOut& out = taken_out_.emplace_back();
  out.block = b;
  const auto take = [](auto& from, auto& to, const auto& is_of_block) {
    const auto taken = std::ranges::stable_partition(from, std::not_fn(is_of_block));
    to.assign(std::make_move_iterator(taken.begin()), std::make_move_iterator(taken.end()));
    from.erase(taken.begin(), taken.end());
  };
  const auto of_block = [b](auto& action) { return block_of(action) == b; };
  for_lists(out, [&](auto& from, auto& to) { take(from, to, of_block); });
  std::erase_if(water.faces, of_block);
  take(prescribed_dofs_, out.prescribed_dofs,
       [&](const PrescribedDof& held) { return block_of_point_[held.vertex] == b; });
  take(supported_vertices, out.supported_vertices, [&](int point) { return block_of_point_[point] == b; });
  for (std::size_t i = 0; i < bolts.size(); ++i)
    for (std::size_t k = 0; k < bolts[i].nodes.size(); ++k)
      if (bolts[i].nodes[k].block == b) {
        bolts[i].nodes[k].block = -1;
        out.bolt_nodes.emplace_back(i, k);
      }
  number_equations();
}

void BlockSystem::restore(int b, double time) {
  const auto found = std::ranges::find(taken_out_, b, &TakenOut::block);
  assert(found != taken_out_.end() && !present_[b]);
  present_[b] = true;
  TakenOut& out = *found;
  const auto begin = [&](auto& held) { held.motion.begin(time, end_time); };
  std::ranges::for_each(out.fixed_vertices, begin);
  std::ranges::for_each(out.prescribed_dofs, begin);
  const auto give = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  out.for_lists(*this, give);
  give(out.prescribed_dofs, prescribed_dofs_);
  give(out.supported_vertices, supported_vertices);
  std::ranges::sort(supported_vertices);
  for (const auto& [bolt, node] : out.bolt_nodes) bolts[bolt].nodes[node].block = b;
  taken_out_.erase(found);
  number_equations();
}

void BlockSystem::number_equations() {
  equation_.assign(n_unknowns_, 0);
  for (int b = 0; b < n_blocks(); ++b)
    if (!present_[b] || resting_[b])
      std::fill_n(equation_.begin() + block(b).unknowns().first, block(b).unknowns().count, -1);
  for (const PrescribedDof& h : prescribed_dofs_) equation_[h.unknown] = -1;
  n_equations_ = 0;
  for (int& e : equation_)
    if (e >= 0) e = n_equations_++;

  movable_.assign(n_blocks(), false);
  free_.assign(n_blocks(), true);
  unchanging_.assign(n_blocks(), true);
  std::vector<bool> moved(n_unknowns_, true);
  for (const PrescribedDof& h : prescribed_dofs_) moved[h.unknown] = h.moves();
  for (int b = 0; b < n_blocks(); ++b) {
    const Range& u = block(b).unknowns();
    if (!present_[b] || resting_[b]) {
      free_[b] = false;
      continue;
    }
    for (int k = u.first; k < u.end(); ++k) {
      if (equation_[k] >= 0) movable_[b] = true;
      if (equation_[k] < 0) free_[b] = false;
      if (moved[k]) unchanging_[b] = false;
    }
  }
}

BlockState BlockSystem::initial_state() const {
  BlockState state;
  state.origin.resize(2, n_blocks());
  state.position = reference();
  for (int b = 0; b < n_blocks(); ++b) {
    state.origin.col(b) = block(b).grid_point(block(b).outline(state).rowwise().mean());
    block(b).points().columns_of(state.position).colwise() -= state.origin.col(b);
  }
  state.velocity = state.carried = VectorXd::Zero(n_unknowns_);
  state.stress.setZero(Eigen::NoChange, n_stress_points_);
  state.rotation = VectorXd::Zero(n_blocks());
  state.bolts = VectorXd::Zero(bolts.empty() ? 0 : bolts.back().numbers.end());
  return state;
}

void BlockSystem::reshape(const BlockState& state, bool all) {
  for_all(n_blocks(), [&](int b) {
    if (block(b).follows_shape() && (all || has_matrices(b))) blocks_[b] = block(b).reshaped(state);
  });
}

void BlockSystem::add_gravity(VectorXd& F) const {
  for (int b = 0; b < n_blocks(); ++b)
    if (present_[b]) block(b).add_body_force(block(b).mass_total() / block(b).reference_area() * gravity, F);
}

void BlockSystem::add_loads(const BlockState& state, const TimeSpan& span, VectorXd& F) const {
  assert(F.size() == n_unknowns_ && span.to >= span.from);
  for (const PointLoad& load : point_loads) {
    const Vec2 force = load.force.mean(span, end_time);
    const Block& on = block(load.point.block);
    for (int p = 0; p < on.n_points(); ++p)
      if (load.point.weights[p] != 0) on.vertex_map(p).add_force(load.point.weights[p] * force, F);
  }
  add_edge_forces(state, span, [&](int b, int vertex, const Vec2& force) {
    block(b).vertex_map(vertex).add_force(force, F);
  });
  for (const BodyLoad& load : body_loads)
    block(load.block).add_body_force(load.force.mean(span, end_time), F);
  if (const double left = fading.part_left(span); left > 0) F += left * fading.forces;
  const Vec2 shaking = ground_acceleration(span);
  for (int b = 0; !shaking.isZero(0) && b < n_blocks(); ++b)
    if (present_[b]) block(b).add_body_force(-block(b).mass_total() / block(b).reference_area() * shaking, F);
}

Vec2 BlockSystem::ground_acceleration(const TimeSpan& span) const {
  Vec2 sum = Vec2::Zero();
  for (const TimeFunction& acceleration : ground) sum += acceleration.mean(span, end_time);
  return sum;
}

Vec2 BlockSystem::inward(int b, int edge, const BlockState& state) const {
  const Range& v = block(b).vertices();
  const Vec2 along =
      state.position.col(v.first + (edge + 1) % block(b).n_vertices()) - state.position.col(v.first + edge);
  return {-along.y(), along.x()};
}

Mat2 BlockSystem::impedance_at_ends(const QuietFace& face, const BlockState& state) const {
  const Vec2 normal = inward(face.block, face.edge, state);
  const double length = normal.norm();
  const BlockMaterial& material = block(face.block).material();
  const double density = block(face.block).mass_total() / block(face.block).reference_area(),
               pressure_wave = std::sqrt(density * material.elasticity(0, 0)),
               shear_wave = std::sqrt(density * material.elasticity(2, 2));
  const Mat2 across = normal * normal.transpose() / (length * length);
  return length / 2 * (pressure_wave * across + shear_wave * (Mat2::Identity() - across));
}

void BlockSystem::add_edge_forces(const BlockState& state, const TimeSpan& span, const AddForce& add) const {
  const auto end_of = [&](int b, int edge) { return (edge + 1) % block(b).n_vertices(); };
  const auto at = [&](int b, int vertex) -> Vec2 {
    return state.position.col(block(b).vertices().first + vertex);
  };
  const auto add_at_ends = [&](int b, int edge, const Vec2& force) {
    for (const int vertex : {edge, end_of(b, edge)}) add(b, vertex, force / 2);
  };
  for (const PressureLoad& load : pressure_loads)
    add_at_ends(load.block, load.edge,
                load.pressure.mean(span, end_time).x() * inward(load.block, load.edge, state));
  for (const QuietFace& face : quiet_faces) {
    const Vec2 outward = -inward(face.block, face.edge, state);
    const auto traction = [&](int end) -> Vec2 {
      const auto s = face.stress.col(end);
      return {s[0] * outward.x() + s[2] * outward.y(), s[2] * outward.x() + s[1] * outward.y()};
    };
    const Vec2 of_wave = 2 * impedance_at_ends(face, state) * face.incoming.mean(span, end_time);
    for (const int end : {0, 1})
      add(face.block, end == 0 ? face.edge : end_of(face.block, face.edge),
          (2 * traction(end) + traction(1 - end)) / 6 + of_wave);
  }
  const double unit_weight = -water.water.density * gravity.y();
  for (const WetFace& face : water.faces) {
    const Points& table = face.in_joint ? water.water.joint_table : water.water.table;
    if (table.cols() == 0) continue;
    const int end = end_of(face.block, face.edge);
    const Vec2 origin = state.origin.col(face.block);
    const EdgeForces forces = water_forces(table, unit_weight, origin + at(face.block, face.edge),
                                           origin + at(face.block, end), face.from, face.to);
    if (!forces.start.isZero(0)) add(face.block, face.edge, forces.start);
    if (!forces.end.isZero(0)) add(face.block, end, forces.end);
  }
}

std::vector<const TimeFunction*> BlockSystem::time_functions() const {
  std::vector<const TimeFunction*> functions;
  for_load_functions([&](int, const TimeFunction& function) { functions.push_back(&function); });
  for (const TimeFunction& acceleration : ground) functions.push_back(&acceleration);
  for (const PrescribedDof& held : prescribed_dofs_) functions.push_back(&held.motion);
  for (const FixedVertex& held : fixed_vertices) functions.push_back(&held.motion);
  return functions;
}

void BlockSystem::find_coordinates(BlockState& state) const {
  state.coordinates = VectorXd::Zero(n_coordinates_);
  for_all(n_blocks(), [&](int b) {
    if (unchanging_[b] || !block(b).shape()) return;
    const Range &c = block(b).coordinates(), &p = block(b).points();
    const CorotationalShape& shape = *block(b).shape();
    const Points nodes = NodalKinematics<polyfem::AnyNodes>(shape).of_points(p.columns_of(state.position));
    c.of(state.coordinates) = shape.motions().coordinates_of(nodes);
  });
}

VectorXd BlockSystem::prescribed(const BlockState& state, double time) const {
  VectorXd d = VectorXd::Zero(n_unknowns_);
  for (const PrescribedDof& h : prescribed_dofs_) {
    const Vec2 target = h.motion.at(time, end_time);
    d[h.unknown] = target[h.axis] - total_displacement(state, h.vertex, h.axis);
  }
  return d;
}

Points BlockSystem::positions(const BlockState& state) const {
  Points x = state.position;
  for (Index v = 0; v < x.cols(); ++v) x.col(v) += state.origin.col(block_of_point_[v]);
  return x;
}

Points BlockSystem::displacements(const BlockState& state) const {
  const BlockState& zero = displacement_zero();
  Points u = state.position - zero.position;
  for (Index v = 0; v < u.cols(); ++v)
    u.col(v) += state.origin.col(block_of_point_[v]) - zero.origin.col(block_of_point_[v]);
  return u;
}

double BlockSystem::total_displacement(const BlockState& state, int point, int axis) const {
  const int b = block_of_point_[point];
  return (state.position(axis, point) - start_.position(axis, point)) +
         (state.origin(axis, b) - start_.origin(axis, b));
}

void BlockSystem::count_displacements_from(const BlockState& zero) {
  zero_ = {};
  if (zero.position.size() == 0 || (zero.position == start_.position && zero.origin == start_.origin)) return;
  zero_.position = zero.position;
  zero_.origin = zero.origin;
}

Points BlockSystem::outline_from(const BlockState& state, int b, int origin_of) const {
  const Vec2 shift = state.origin.col(b) - state.origin.col(origin_of);
  return block(b).outline(state).colwise() + shift;
}

Vec2 BlockSystem::interpolate(const MaterialPoint& point, const Points& at_points) const {
  return block(point.block).points().columns_of(at_points) * point.weights;
}

Vec2 BlockSystem::displacement(const MaterialPoint& point, const VectorXd& d) const {
  const Block& on = block(point.block);
  Vec2 u = Vec2::Zero();
  for (int p = 0; p < on.n_points(); ++p)
    if (point.weights[p] != 0) u += point.weights[p] * on.vertex_map(p)(d);
  return u;
}

double best_fit_rotation(const PointsRef& reference, const PointsRef& outline) {
  const Vec2 p = reference.rowwise().mean(), q = outline.rowwise().mean();
  double sine = 0, cosine = 0;
  for (Index v = 0; v < reference.cols(); ++v) {
    const Vec2 a = reference.col(v) - p, b = outline.col(v) - q;
    sine += cross(a, b);
    cosine += a.dot(b);
  }
  return std::atan2(sine, cosine);
}

}  // namespace ddacontact
