#include <ddacontact/equations/step_system.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/core/symmetric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace ddacontact {

namespace {

/// What is left of forces by the round-off of the lengths that they follow from: so many units of it.
constexpr double units = 64, floor_factor = units * std::numeric_limits<double>::epsilon();

/// A change moves no block further than this part of its size.
constexpr double largest_move = 0.25;

/// Marks the unknowns of a block that by themselves move it without straining it.
void mark_motions_of_the_whole(const RigidModes& modes, char* marks) {
  for (const auto& mode : modes.colwise()) {
    Index unknown = 0;
    mode.cwiseAbs().maxCoeff(&unknown);
    if ((mode.array() != 0).count() == 1) marks[unknown] = 1;
  }
}

/// The shape when loads act, if the motion at the start goes on.
BlockState predicted(const BlockSystem& blocks, const BlockState& state, const StepStart& start) {
  const double t = start.rule.load_span(0, start.dt).middle();
  VectorXd d = t * start.velocity;
  if (start.rule.scheme == Scheme::newmark) d += t * t / 2 * start.acceleration;
  BlockState then = state;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    for (int v = 0; v < blocks.block(b).n_vertices(); ++v)
      then.position.col(blocks.block(b).vertices().first + v) += blocks.block(b).vertex_map(v)(d);
  return then;
}

}  // namespace

StepSystem::StepSystem(const BlockSystem& blocks)
    : blocks_(blocks),
      steps_(static_cast<std::size_t>(blocks.n_blocks())),
      unknown_lengths_(blocks.n_unknowns()),
      moves_as_a_whole_(static_cast<std::size_t>(blocks.n_unknowns()), 0),
      problem_(blocks.equation(), blocks.n_equations()) {
  polyfem::Connectivity elements;  // the parts of the assembled blocks, one after another
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Range& u = blocks.block(b).unknowns();
    u.of(unknown_lengths_) = blocks.block(b).unknown_lengths();
    if (!blocks.is_unchanging(b)) active_.push_back(b);
    if (!blocks.has_matrices(b)) continue;
    mark_motions_of_the_whole(blocks.block(b).rigid_modes(blocks.drawn()), &moves_as_a_whole_[u.first]);
    assembled_.push_back(b);
    first_element_.push_back(elements.n_elements());
    for (int p = 0; p < blocks.block(b).n_parts(); ++p) {
      std::vector<int> of_part = blocks.block(b).part_unknowns(p);
      for (int& k : of_part) k += u.first;
      elements.append(of_part);
    }
  }
  for (std::vector<int>* numbers : {&active_, &assembled_, &first_element_}) numbers->shrink_to_fit();
  for (const QuietFace& face : blocks.quiet_faces)
    if (!blocks.is_unchanging(face.block))
      elements.append(quiet_faces_.emplace_back(blocks, face).unknowns());
  for (const Bolt& bolt : blocks.bolts)
    if (acts(bolt, blocks)) elements.append(work_.bolts.emplace_back(blocks, bolt).unknowns());
  problem_.set_matrices(std::move(elements));
}

void StepSystem::set_step(const BlockState& state, const StepStart& start, double fixed_point_stiffness) {
  assert(start.dt > 0 && start.velocity.size() == blocks_.n_unknowns());
  dt_ = start.dt;
  rule_ = start.rule;
  fixed_point_stiffness_ = fixed_point_stiffness;
  const double time = state.time + dt_;
  prescribed_ = blocks_.prescribed(state, time);
  fixed_point_springs_.clear();
  for (std::size_t h = 0; h < blocks_.fixed_vertices.size(); ++h) {
    const FixedVertex& prescribed = blocks_.fixed_vertices[h];
    const int v = blocks_.block(prescribed.block).vertices().first + prescribed.vertex;
    for (int axis = 0; axis < 2; ++axis) {
      if (!(axis == 0 ? prescribed.x : prescribed.y)) continue;
      FixedPointSpring spring{static_cast<int>(h), axis, {}, 0};
      blocks_.block(prescribed.block).vertex_map(prescribed.vertex).add_to(spring.form, Vec2::Unit(axis));
      const auto target_at = [&](double then) { return prescribed.motion.at(then, blocks_.end_time)[axis]; };
      const double target = target_at(time);
      spring.target_change = target - target_at(state.time);
      spring.form.constant = blocks_.total_displacement(state, v, axis) - target;
      fixed_point_springs_.push_back(spring);
    }
  }
  for (StepQuietFace& face : quiet_faces_) face.begin(blocks_, state, start);
  for (StepBolt& bolt : work_.bolts) bolt.begin(blocks_, state, rule_.directions());
  if (rule_.has_half_steps() && !work_.bolts.empty()) take_stable_directions();
  for_all(assembled_.size(), [&](int a) {
    const int b = assembled_[a];
    blocks_.block(b).begin_step(state, start, steps_[b]);
  });
  work_.own_at.resize(0);
  diagonal_.resize(0);
  load_forces_ = gravity_forces_ = VectorXd::Zero(blocks_.n_unknowns());
  blocks_.add_loads(
      start.rule.predicts_shape() && blocks_.has_face_loads() ? predicted(blocks_, state, start) : state,
      rule_.load_span(state.time, dt_), load_forces_);
  blocks_.add_gravity(gravity_forces_);
}

void StepSystem::take_stable_directions() {
  VectorXd turning = VectorXd::Zero(blocks_.n_blocks());
  for (const StepBolt& bolt : work_.bolts) bolt.add_turning(turning);
  const auto turns_far = [&](int b) {
    return blocks_.is_movable(b) && turning[b] * dt_ * dt_ > blocks_.block(b).mass_total() / 2;
  };
  for (StepBolt& bolt : work_.bolts)
    if (rule_.starts_at_rest || std::ranges::any_of(bolt.blocks(), turns_far))
      bolt.act_along(Directions::of_end);
}

void StepSystem::find_own_forces(const VectorXd& d) const {
  if (work_.own_at.size() == d.size() && work_.own_at == d) return;
  work_.own_at = d;
  work_.own_forces.resize(d.size());
  work_.own_sums.resize(active_.size());
  for_all(active_.size(), [&](int a) {
    thread_local BlockForces of_block;
    const int b = active_[a];
    const Range& u = blocks_.block(b).unknowns();
    const auto lengths = u.of(unknown_lengths_);
    step(b).forces(u.of(d), of_block);
    u.of(work_.own_forces) = of_block.elastic() + of_block.inertia() + of_block.damping();
    double sum = 0;
    for (const auto& f : {of_block.elastic(), of_block.inertia(), of_block.damping()})
      sum += f.cwiseQuotient(lengths).lpNorm<1>();
    for (const VectorXd* f : {&load_forces_, &gravity_forces_})
      sum += u.of(*f).cwiseQuotient(lengths).lpNorm<1>();
    work_.own_sums[a] = {sum, u.of(d).cwiseProduct(lengths).lpNorm<Eigen::Infinity>()};
  });
}

void StepSystem::compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                                  const std::vector<ContactTerm>& terms,
                                  const std::vector<ContactForce>& forces, Residual& residual) const {
  assert(terms.size() == contacts.size() && forces.size() == contacts.size());
  work_.magnitude.setZero(blocks_.n_blocks());
  work_.stiffest.setZero(blocks_.n_blocks());
  residual.external = load_forces_ + gravity_forces_;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (forces[c].normal == 0 && forces[c].shear == 0) continue;
    terms[c].gap.add_gradient(forces[c].normal, residual.external);  // (40), (48), (52)
    terms[c].slip.add_gradient(forces[c].shear, residual.external);
    const double magnitude = std::hypot(forces[c].normal, forces[c].shear);
    for (int b : contacts[c].pair.blocks()) add_force_on(b, magnitude, contacts[c].law.normal_stiffness);
  }
  add_fixtures(d, residual.external);
  find_own_forces(d);
  residual.force = -residual.external;
  work_.sums.assign(blocks_.n_blocks(), {0, 0, inf, 0});
  for_all(active_.size(), [&](int a) { work_.sums[active_[a]] = sum_up(a, residual.force); });
  measure(residual);
}

void StepSystem::add_force_on(int block, double magnitude, double stiffness) const {
  work_.magnitude[block] += magnitude;
  work_.stiffest[block] = std::max(work_.stiffest[block], stiffness);
}

void StepSystem::add_fixtures(const VectorXd& d, VectorXd& external) const {
  for (const FixedPointSpring& spring : fixed_point_springs_) {
    const double force = -fixed_point_stiffness_ * spring.form(d);
    spring.form.add_gradient(force, external);
    add_force_on(blocks_.fixed_vertices[spring.fixed_vertex].block, std::abs(force), fixed_point_stiffness_);
  }
  if (!quiet_faces_.empty()) {
    const VectorXd of_faces = quiet_forces(d);
    external += of_faces;
    for (const StepQuietFace& face : quiet_faces_) {
      const Range& u = blocks_.block(face.block()).unknowns();
      add_force_on(face.block(), u.of(of_faces).lpNorm<Eigen::Infinity>(), 0);
    }
  }
  for (const StepBolt& bolt : bolts_at(d)) {
    bolt.add_forces(external);
    for (std::size_t i = 0; i < bolt.bolt().nodes.size(); ++i)
      if (const int b = bolt.bolt().nodes[i].block; b >= 0)
        add_force_on(b, bolt.force_on(static_cast<int>(i)).norm(), bolt.largest_stiffness());
  }
}

StepSystem::Sums StepSystem::sum_up(int a, VectorXd& force) const {
  const int b = active_[a];
  const Block& block = blocks_.block(b);
  const Range& u = block.unknowns();
  const auto lengths = u.of(unknown_lengths_);
  auto r = u.of(force);
  r += u.of(work_.own_forces);
  const auto& [own, furthest] = work_.own_sums[a];
  // With half steps forces follow from deformations and from changes of gaps: of places round-off is left
  // by one unit.
  const double length = (rule_.has_half_steps() ? 1 / units : 1) * block.size() + furthest;
  const double round_off = floor_factor * ((block.material().elasticity(0, 0) + work_.stiffest[b]) * length +
                                           rule_.inertia() * block.mass_total() / (dt_ * dt_) * furthest);
  double largest = 0, left = 0;
  for (int k = 0; k < u.count; ++k) {
    if (blocks_.equation()[u.first + k] < 0) continue;
    const double size = std::abs(r[k]) / lengths[k];
    if (!(size <= largest)) largest = size;  // lets a NaN through
    left += std::max(size - round_off, 0.0);
  }
  return {largest, left, work_.magnitude[b] + own, round_off};
}

void StepSystem::measure(Residual& residual) const {
  residual.worst_block = -1;
  residual.largest = residual.scale = residual.round_off = residual.block_relative = residual.over_round_off =
      0;
  for (const int b : active_) {
    const auto [largest, left, sum, round_off] = work_.sums[b];
    residual.scale = std::max(residual.scale, sum);
    residual.round_off = std::max(residual.round_off, round_off);
    if (!(largest <= residual.largest)) residual.largest = largest;
    const double own = left == 0 ? 0 : sum > 0 ? left / sum : inf;
    if (!(own <= residual.block_relative)) {
      residual.block_relative = own;
      residual.worst_block = b;
    }
    residual.over_round_off = std::max(residual.over_round_off, largest / round_off);
  }
}

void StepSystem::displace(int b, const VectorXd& d, VectorXd& displaced) const {
  const Range& u = blocks_.block(b).unknowns();
  step(b).displacement(u.of(d), u.of(displaced));
}

VectorXd StepSystem::displacement(VectorXd& d) const {
  if (!rule_.has_half_steps()) return d;
  VectorXd displaced = d;
  for_all(active_.size(), [&](int a) { displace(active_[a], d, displaced); });
  // A point that turns with its block leaves the straight line that its support prescribes.
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<int> moved;
    for (const PrescribedDof& held : blocks_.prescribed_dofs()) {
      const int b = blocks_.block_of_unknown(held.unknown);
      const double error = displaced[held.unknown] - prescribed_[held.unknown];
      if (blocks_.is_unchanging(b) || std::abs(error) <= few_ulps * blocks_.block(b).size()) continue;
      d[held.unknown] -= error;
      if (moved.empty() || moved.back() != b) moved.push_back(b);
    }
    if (moved.empty()) break;
    for (int b : moved) displace(b, d, displaced);
  }
  return displaced;
}

void StepSystem::end(const VectorXd& d, const VectorXd& external, BlockState& next) const {
  for_all(active_.size(), [&](int a) {
    const int b = active_[a];
    const Range& u = blocks_.block(b).unknowns();
    step(b).end(u.of(d), u.of(external), blocks_.is_free(b), next);
  });
}

VectorXd StepSystem::quiet_forces(const VectorXd& d) const {
  VectorXd F = VectorXd::Zero(d.size());
  for (const StepQuietFace& face : quiet_faces_) face.add_forces(d, F);
  return F;
}

const std::vector<StepBolt>& StepSystem::bolts_at(const VectorXd& d) const {
  if (work_.bolts.empty()) return work_.bolts;
  VectorXd displaced = d;
  for (StepBolt& bolt : work_.bolts) {
    for (int b : bolt.blocks())
      if (!blocks_.is_unchanging(b)) displace(b, d, displaced);
    bolt.evaluate(displaced);
  }
  return work_.bolts;
}

VectorXd StepSystem::bolt_forces(const VectorXd& d) const {
  VectorXd F = VectorXd::Zero(d.size());
  for (const StepBolt& bolt : bolts_at(d)) bolt.add_forces(F);
  return F;
}

VectorXd StepSystem::free_path() const {
  VectorXd d = prescribed_;
  for_all(active_.size(),
          [&](int a) { step(active_[a]).free_path(blocks_.block(active_[a]).unknowns().of(d)); });
  for (const PrescribedDof& prescribed : blocks_.prescribed_dofs())
    d[prescribed.unknown] = prescribed_[prescribed.unknown];
  return d;
}

/// Blocks that are carried on by their motions have one matrix for all d.
void StepSystem::linearize(const VectorXd& d) {
  const auto is_moved_by_motions = [&](int b) { return step(b).motion() != nullptr; };
  if (diagonal_.size() > 0 && work_.bolts.empty() && std::ranges::all_of(assembled_, is_moved_by_motions))
    return;
  diagonal_ = VectorXd::Zero(blocks_.n_unknowns());
  for_all(assembled_.size(), [&](int a) {
    const Block& block = blocks_.block(assembled_[a]);
    const Range& u = block.unknowns();
    step(assembled_[a]).tangent(u.of(d), problem_.elements().subspan(first_element_[a], block.n_parts()));
  });
  for (const FixedPointSpring& spring : fixed_point_springs_) {
    const int b = blocks_.fixed_vertices[spring.fixed_vertex].block;
    const auto assembled = std::ranges::lower_bound(assembled_, b);
    const Range& u = blocks_.block(b).unknowns();
    VectorXd a = VectorXd::Zero(u.end());
    spring.form.add_gradient(1, a);
    problem_.elements()[first_element_[assembled - assembled_.begin()]] +=
        fixed_point_stiffness_ * u.of(a) * u.of(a).transpose();
  }
  const polyfem::Connectivity& elements = problem_.unknowns();
  int of_faces = elements.n_elements() - static_cast<int>(quiet_faces_.size() + work_.bolts.size());
  for (const StepQuietFace& face : quiet_faces_) problem_.elements()[of_faces++] = face.tangent();
  for (const StepBolt& bolt : bolts_at(d)) problem_.elements()[of_faces++] = bolt.tangent();
  assert(std::ranges::all_of(problem_.elements(), is_symmetric));
  for (int e = 0; e < elements.n_elements(); ++e)
    diagonal_(elements.rows_of(e)) += problem_.elements()[e].diagonal();
  for_all(active_.size(), [&](int a) {
    const Range& u = blocks_.block(active_[a]).unknowns();
    for (int k = u.first; k < u.end(); ++k)
      if (blocks_.equation()[k] < 0 || moves_as_a_whole_[k]) diagonal_[k] = inf;
  });
  problem_.matrices_changed();
}

double StepSystem::largest_motion(int block, const VectorXd& d) const {
  const Range& u = blocks_.block(block).unknowns();
  return u.of(d).cwiseProduct(u.of(unknown_lengths_)).lpNorm<Eigen::Infinity>();
}

void StepSystem::move(const VectorXd& whole_change, VectorXd& d) const {
  assert(whole_change.size() == d.size());
  double furthest = 0;  // relative to the block's size
  for (int b : active_)
    furthest = std::max(furthest, largest_motion(b, whole_change) / blocks_.block(b).size());
  const VectorXd change = whole_change * (furthest > largest_move ? largest_move / furthest : 1);
  for_all(active_.size(), [&](int a) {
    const int b = active_[a];
    const Range& u = blocks_.block(b).unknowns();
    if (blocks_.is_free(b))
      step(b).add_change(u.of(change), u.of(d));
    else
      u.of(d) += u.of(change);
  });
}

double StepSystem::contact_stiffness(const Contact& contact) const {
  const VertexEdgePositions& place = contact.motion.start;
  const Vec2 along = place.along(), normal = place.outwards();
  const auto [vertex_block, vertex, edge_block, edge, corner] = contact.pair;
  const int next = (edge + 1) % blocks_.block(edge_block).n_vertices();
  const double t = std::clamp((place.i - place.j).dot(along) / contact.edge_length(), 0.0, 1.0);
  const double of_vertex = vertex_stiffness(vertex_block, vertex, normal),
               of_edge = 1 / ((1 - t) * (1 - t) / vertex_stiffness(edge_block, edge, normal) +
                              t * t / vertex_stiffness(edge_block, next, normal));
  return std::min(of_vertex, of_edge);
}

std::optional<std::vector<double>> StepSystem::bends(const VectorXd& d, const VectorXd& change) const {
  std::vector<double> bends(static_cast<std::size_t>(blocks_.n_blocks()));
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const double last = largest_motion(b, change);
    bends[b] = last * (largest_motion(b, d) + last) / blocks_.block(b).size();
  }
  for (const PrescribedDof& held : blocks_.prescribed_dofs())
    if (const int b = blocks_.block_of_point(held.vertex);
        blocks_.is_movable(b) && bends[b] > few_ulps * blocks_.block(b).size())
      return {};
  return bends;
}

double StepSystem::vertex_stiffness(int b, int vertex, const Vec2& normal) const {
  if (blocks_.is_unchanging(b)) return inf;
  AffineForm form;
  const Block& block = blocks_.block(b);
  block.vertex_map(vertex).add_to(form, normal);
  // Of the unknowns that move the vertex by straining the block those with the least stiffness for their
  // lever give the estimate: what presses a vertex strains the block, whose mass alone may resist hardly.
  double softness = 0;
  form.for_terms([&](int unknown, double c) { softness += c * c / diagonal_[unknown]; });
  return softness > 0 ? 1 / softness : inf;
}

}  // namespace ddacontact
