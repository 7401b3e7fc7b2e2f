#include <ddacontact/equations/step_bolt.hpp>

#include <ddacontact/core/sort_once.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// Calls visit(unknown, column) for the unknowns that move a node.
template <class Visit>
void for_terms(const BlockSystem& blocks, const MaterialPoint& node, Visit&& visit) {
  if (node.block < 0) return;
  const Block& block = blocks.block(node.block);
  for (int p = 0; p < block.n_points(); ++p)
    if (node.weights[p] != 0)
      block.vertex_map(p).for_terms(
          [&](int unknown, const Vec2& column) { visit(unknown, node.weights[p] * column); });
}

}  // namespace

StepBolt::StepBolt(const BlockSystem& blocks, const Bolt& bolt)
    : bolt_(&bolt), maps_(bolt.nodes.size()), segments_(bolt.nodes.size() - 1) {
  for (const MaterialPoint& node : bolt.nodes) {
    if (node.block < 0) continue;
    const Range& u = blocks.block(node.block).unknowns();
    blocks_.push_back(node.block);
    // The map of a block of six unknowns may change with its shape.
    if (u.count <= PointMap::capacity)
      for (int k = u.first; k < u.end(); ++k) unknowns_.push_back(k);
    else
      for_terms(blocks, node, [&](int unknown, const Vec2&) { unknowns_.push_back(unknown); });
  }
  for (std::vector<int>* list : {&unknowns_, &blocks_}) sort_once(*list);
}

void StepBolt::begin(const BlockSystem& blocks, const BlockState& state, Directions directions) {
  directions_ = directions;
  numbers_ = bolt_->numbers.of(state.bolts);
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    maps_[i].clear();
    for_terms(blocks, bolt_->nodes[i], [&](int unknown, const Vec2& column) {
      const auto slot = std::ranges::lower_bound(unknowns_, unknown) - unknowns_.begin();
      maps_[i].push_back({unknown, static_cast<int>(slot), column});
    });
  }
  for (int k = 0; k < bolt_->n_segments(); ++k) {
    segments_[k].is_there = bolt_->has_segment(k);
    if (segments_[k].is_there) segments_[k].start = segment_vector(*bolt_, k, blocks, state);
  }
  start_ = bolt_forces(*bolt_, numbers_, elongations(*bolt_, blocks, state));
}

void StepBolt::add_turning(VectorXd& of_blocks) const {
  for (int k = 0; k < bolt_->n_segments(); ++k) {
    const int a = bolt_->nodes[k].block, b = bolt_->nodes[k + 1].block;
    if (!segments_[k].is_there || a == b) continue;
    const double turning = std::max(start_.axial[k], 0.0) / segments_[k].start.norm();
    for (const int block : {a, b})
      if (block >= 0) of_blocks[block] += turning;
  }
}

Vec2 StepBolt::displacement(int node, const VectorXd& displaced) const {
  Vec2 u = Vec2::Zero();
  for (const Term& term : maps_[node]) u += displaced[term.unknown] * term.column;
  return u;
}

void StepBolt::evaluate(const VectorXd& displaced) {
  elongation_ = VectorXd::Zero(bolt_->n_segments());
  for (int k = 0; k < bolt_->n_segments(); ++k) {
    Segment& segment = segments_[k];
    if (!segment.is_there) continue;
    const Vec2 end = segment.start + displacement(k + 1, displaced) - displacement(k, displaced);
    const double length = segment.start.norm();
    segment.length = end.norm();
    elongation_[k] = segment.length - numbers_[Bolt::length(k)];
    segment.direction = directions_ == Directions::of_start ? Vec2(segment.start / length)
                        : directions_ == Directions::of_end
                            ? Vec2(end / segment.length)
                            : Vec2((segment.start + end) / (length + segment.length));
  }
  forces_ = bolt_forces(*bolt_, numbers_, elongation_);
  axial_ = directions_ == Directions::mean ? VectorXd((start_.axial + forces_.axial) / 2) : forces_.axial;
  for (int k = 0; k < bolt_->n_segments(); ++k) {
    Segment& segment = segments_[k];
    const double length = segment.length + (directions_ == Directions::mean ? segment.start.norm() : 0);
    segment.turning =
        directions_ == Directions::of_start || length == 0 ? 0 : std::max(axial_[k], 0.0) / length;
  }
}

Vec2 StepBolt::force_on(int node) const {
  Vec2 force = Vec2::Zero();
  if (node < bolt_->n_segments()) force += axial_[node] * segments_[node].direction;
  if (node > 0) force -= axial_[node - 1] * segments_[node - 1].direction;
  return force;
}

void StepBolt::add_forces(VectorXd& F) const {
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const Vec2 force = force_on(static_cast<int>(i));
    for (const Term& term : maps_[i]) F[term.unknown] += term.column.dot(force);
  }
}

MatrixXd StepBolt::tangent() const {
  const Index n_segments = bolt_->n_segments(), n = static_cast<Index>(unknowns_.size());
  MatrixXd along = MatrixXd::Zero(n_segments, n), across = along;  // derivatives of what segments move by
  for (Index k = 0; k < n_segments; ++k) {
    const Segment& segment = segments_[k];
    const Vec2 normal(-segment.direction.y(), segment.direction.x());
    for (const auto& [node, sign] : {std::pair{k, -1}, std::pair{k + 1, 1}})
      for (const Term& term : maps_[node]) {
        along(k, term.slot) += sign * term.column.dot(segment.direction);
        across(k, term.slot) += sign * std::sqrt(segment.turning) * term.column.dot(normal);
      }
  }
  const double part = directions_ == Directions::mean ? 0.5 : 1;
  return part * along.transpose() * forces_.stiffness * along + across.transpose() * across;
}

double StepBolt::largest_stiffness() const {
  double largest = 0;
  for (int k = 0; k < bolt_->n_segments(); ++k)
    if (segments_[k].is_there) largest = std::max(largest, bolt_->stiffness / numbers_[Bolt::length(k)]);
  return largest;
}

BoltLosses StepBolt::end(VectorXd& numbers) const {
  auto own = bolt_->numbers.of(numbers);
  BoltLosses losses = follow(*bolt_, elongation_, own);
  if (directions_ != Directions::mean || losses.tears) return losses;
  // With means what yields takes the mean of its force at both ends.
  const auto correct = [&](int plastic, double force, double force_at_start) {
    losses.dissipated -= (force - force_at_start) / 2 * (own[plastic] - numbers_[plastic]);
  };
  for (int k = 0; k < bolt_->n_segments(); ++k) correct(Bolt::plastic(k), forces_.axial[k], start_.axial[k]);
  for (int i = 0; i < forces_.bond.size(); ++i)
    correct(bolt_->plastic_slip(i), forces_.bond[i], start_.bond[i]);
  return losses;
}

}  // namespace ddacontact
