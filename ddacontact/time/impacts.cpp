#include <ddacontact/time/impacts.hpp>

#include <ddacontact/block/motion_shape.hpp>
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/core/disjoint_sets.hpp>
#include <ddacontact/time/free_flight.hpp>
#include <ddacontact/time/impact_criteria.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

namespace {

/// Newton's corrections of the time of a meeting, from the parabola that the gap nearly is.
constexpr int corrections = 2;

/// Blocks on their way within a step, from one impact to the next.
class Flight : ImpactStep {
 public:
  Flight(const ImpactStep& step, const std::vector<char>& forced)
      : ImpactStep(step),
        forced_(forced),
        start_(state),
        acceleration_(VectorXd::Zero(start_.velocity.size())),
        bears_(blocks.n_blocks(), 0),
        last_(blocks.n_blocks(), 0),
        meetings_(contacts.size()),
        yields_(contacts.size(), 0) {
    result_.hit.assign(contacts.size(), 0);
    for (const Contact& contact : contacts)
      if (bears(contact)) bears_[contact.pair.vertex_block] = bears_[contact.pair.edge_block] = 1;
    forces_.setZero(acceleration_.size());
    blocks.add_loads(start_, rule.load_span(start_.time, dt), forces_);
    for (int b = 0; b < blocks.n_blocks(); ++b)
      if (!bears_[b] && blocks.is_free(b)) blocks.block(b).unknowns().of(acceleration_) = acceleration(b);
  }

  StepImpact follow() {
    look_ahead(std::vector<char>(blocks.n_blocks(), 1));
    for (std::size_t round = 0; round < contacts.size() && collide(); ++round) look_ahead(hit_now_);
    if (result_.n_hits > 0) result_.start = std::move(start_);
    return std::move(result_);
  }

  /// Of the free blocks that an impact makes jump.
  void find_acceleration_before(StepImpact& impact) {
    for (const Contact& contact : contacts) {
      contact.motion.form(contact.first_gap().gradient).add_gradient(contact.history.normal, forces_);
      contact.motion.form(contact.first_slip().gradient).add_gradient(contact.history.shear, forces_);
    }
    for (int b = 0; b < blocks.n_blocks(); ++b)
      if (blocks.is_free(b) && !blocks.block(b).unknowns().of(impact.jump).isZero(0))
        impact.acceleration_before.emplace_back(b, acceleration(b));
  }

 private:
  /// Of a free block as a rigid body at the start of the step, by gravity and the forces known so far.
  VectorXd acceleration(int b) const {
    const Block& block = blocks.block(b);
    return block.translations() * blocks.gravity +
           as_velocity(block, state, rigid_velocity_by(block, state, block.unknowns().of(forces_)));
  }

  /// When the blocks of a contact meet next, and how fast.
  struct Meeting {
    double time = inf, approach = 0;
  };

  bool bears(const Contact& contact) const { return ddacontact::bears(blocks, contact, dt); }

  /// Finds meetings of these blocks, those after the step included that are part of an impact within it.
  void look_ahead(const std::vector<char>& of_blocks) {
    velocity_ = start_.going_on();
    if (rule.has_half_steps()) velocity_ += start_.carried_dt / 2 * acceleration_;
    rigid_ = rigid_velocities(blocks, start_, velocity_);
    centres_.clear();
    for (int b = 0; b < blocks.n_blocks(); ++b) centres_.push_back(blocks.block(b).centroid(start_));
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const VertexEdge& pair = contacts[c].pair;
      if (of_blocks[pair.vertex_block] || of_blocks[pair.edge_block]) meetings_[c] = next_meeting(c);
    }
  }

  Meeting next_meeting(std::size_t c) const {
    const Contact& contact = contacts[c];
    if (!restitution_of(properties, contact.pair, rule)) return {};
    if (bears(contact) && (rule.has_half_steps() || carries_waves(blocks, contact, dt))) return {};
    const MovingVertexEdge& motion = contact.motion;
    const RoundedPositions positions = positions_of(blocks, start_, contact.pair);
    const GapAndSlip at_start = motion.rates_at(positions, contact.history.lock);
    // From the last impact of either on.
    const double since = std::max(last_[contact.pair.vertex_block], last_[contact.pair.edge_block]),
                 ahead = dt + impact_duration(blocks, contact) - since, end = since + ahead,
                 straight = motion.change_along(at_start.by_gap, acceleration_),
                 rate_at_start = motion.change_along(at_start.by_gap, velocity_);
    // The gap as a parabola that has its value and its rate at the start, and its value at the end.
    const auto after = [&](double t) {
      return motion.rates_at(positions_after(contact, t), contact.history.lock);
    };
    const double by_turning = turns(contact.pair)
                                  ? after(end).gap - at_start.gap - end * (rate_at_start + end * straight / 2)
                                  : 0,
                 growth = straight + 2 * by_turning / (end * end), rate = rate_at_start + since * growth,
                 gap = at_start.gap - contact.history.gap_offset + since * (rate - since * growth / 2);
    const bool near = contact.closed() || gap <= contact.length_tolerance();
    Vec2 apart = Vec2::Zero(), passing = Vec2::Zero();
    if (motion.is_at_corner()) {
      passing = from_corner(motion.moved(velocity_), *motion.rounding);
      apart = from_corner(positions, *motion.rounding) + since * passing;
    }
    double time = motion.is_at_corner() && !near ? first_touch(apart, passing, motion.rounding->radius, ahead)
                                                 : first_touch(near ? 0 : gap, rate, growth, ahead);
    // What the solution of the step closes meets within it, and over the edge.
    const bool closes = !forced_.empty() && forced_[c] && !result_.hit[c];
    const double latest = closes ? dt - since : ahead;
    if (closes && !(time <= latest) && rate < 0) time = std::min(latest, std::max(gap, 0.0) / -rate);
    if (!std::isfinite(time)) return {};
    for (int round = 0; by_turning != 0 && time > 0 && !motion.is_at_corner() && round < corrections; ++round)
      if (const double slope = rate + time * growth; slope < 0)
        time = std::clamp(time - (after(since + time).gap - contact.history.gap_offset) / slope, 0., latest);
    const double slip = after(since + time).slip;
    // Corners of faces of one height pass each other by less than joints are flush to, while one vibrates.
    const bool stays = contact.is_on_edge(at_start.slip) &&
                       std::abs(slip - at_start.slip) <= ContactProperties::default_lip * contact.size;
    if (!contact.closed() && !closes && !stays && !contact.is_on_edge(slip)) return {};
    if (passes_corner(blocks, start_, contact, positions_after(contact, since + time), properties.lip))
      return {};
    const double approach =
        motion.is_at_corner() ? -(apart + time * passing).normalized().dot(passing) : -(rate + time * growth);
    if (approach <= least_approach(blocks, contact, dt)) return {};
    return {since + time, approach};
  }

  bool turns(const VertexEdge& pair) const {
    return std::ranges::any_of(pair.blocks(),
                               [&](int b) { return blocks.is_free(b) && rigid_[b].angular != 0; });
  }

  /// Where the vertex and the edge are when their blocks have gone on for a time since the start of the step.
  RoundedPositions positions_after(const Contact& contact, double time) const {
    RoundedPositions at = positions_of(blocks, start_, contact.pair);
    const RoundedPositions velocity = contact.motion.moved(velocity_),
                           acceleration = contact.motion.moved(acceleration_);
    const auto move = [&](int b, Vec2 RoundedPositions::*point) {
      Vec2& x = at.*point;
      const Vec2 centre = centres_[b] - start_.origin.col(contact.pair.edge_block),
                 off = blocks.is_free(b) ? off_straight_line(x - centre, time * rigid_[b].angular)
                                         : Vec2::Zero();
      x += time * (velocity.*point + time / 2 * acceleration.*point) + off;
    };
    move(contact.pair.vertex_block, &RoundedPositions::i);
    move(contact.pair.vertex_block, &RoundedPositions::after_i);
    move(contact.pair.edge_block, &RoundedPositions::j);
    move(contact.pair.edge_block, &RoundedPositions::k);
    return at;
  }

  /// Whether a contact joins its blocks at an impact at this place: closed since the start of the step, or
  /// since an impact in it.
  bool touches(std::size_t c, const GapAndSlip& then) const {
    const Contact& contact = contacts[c];
    if (bears(contact)) return rule.has_half_steps() || !carries_waves(blocks, contact, dt);
    return result_.hit[c] && then.gap - contact.history.gap_offset <= contact.end_tolerance();
  }

  GapAndSlip rates_at(const BlockState& then, const Contact& contact) const {
    return contact.motion.rates_at(positions_of(blocks, then, contact.pair), contact.history.lock);
  }
  /// Whether a block of it collides, at one of these times.
  static bool takes_part(const Contact& contact, const std::vector<double>& times) {
    return std::isfinite(std::min(times[contact.pair.vertex_block], times[contact.pair.edge_block]));
  }

  /// The meetings that come first for all blocks that they concern, those that touch these included. False:
  /// there are none.
  bool find_first(std::vector<double>& times, std::vector<char>& first) const {
    DisjointSets joined(blocks.n_blocks());
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if ((bears(contacts[c]) || result_.hit[c]) &&
          std::ranges::all_of(contacts[c].pair.blocks(), [&](int b) { return blocks.is_movable(b); }))
        joined.join(contacts[c].pair.vertex_block, contacts[c].pair.edge_block);
    std::vector<double> earliest(blocks.n_blocks(), inf);
    const auto for_movable = [&](const VertexEdge& pair, const auto& visit) {
      for (int b : pair.blocks())
        if (blocks.is_movable(b)) visit(joined.root(b));
    };
    for (std::size_t c = 0; c < contacts.size(); ++c)
      for_movable(contacts[c].pair,
                  [&](int root) { earliest[root] = std::min(earliest[root], meetings_[c].time); });
    times.assign(blocks.n_blocks(), inf);
    first.assign(contacts.size(), 0);
    bool any = false;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (!std::isfinite(meetings_[c].time)) continue;
      const double flush = contacts[c].end_tolerance() / meetings_[c].approach;  // at one time, to round-off
      bool is_first = true;
      for_movable(contacts[c].pair, [&](int root) {
        is_first = is_first && earliest[root] <= dt && meetings_[c].time <= earliest[root] + flush;
      });
      if (!is_first) continue;
      first[c] = 1;
      any = true;
      for_movable(contacts[c].pair,
                  [&](int root) { times[root] = std::min(times[root], meetings_[c].time); });
    }
    for (int b = 0; b < blocks.n_blocks(); ++b) times[b] = times[joined.root(b)];
    return any;
  }

  /// Everyone collides where he is when he is hit, turned by then. False: nobody meets any more.
  bool collide() {
    std::vector<double> times;
    std::vector<char> first;
    if (!find_first(times, first)) return false;
    deformation_.setZero(velocity_.size());
    for (int b = 0; b < blocks.n_blocks(); ++b)
      if (const Range& u = blocks.block(b).unknowns(); bears_[b] && blocks.is_free(b))
        u.of(deformation_) = u.of(velocity_) - as_velocity(blocks.block(b), start_, rigid_[b]);
    const BlockState then = carried(blocks, start_, velocity_, acceleration_, times);
    VectorXd before = velocity_;
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      if (!std::isfinite(times[b]) || !blocks.is_free(b)) continue;
      const Range& u = blocks.block(b).unknowns();
      u.of(before) = as_velocity(blocks.block(b), then, rigid_[b]) + times[b] * u.of(acceleration_);
    }
    JumpReport report;
    Colliding part;
    bool deform = rule.has_half_steps(), again;
    do {
      part = find_colliding(then, before, deform, times, first);
      report = impact(blocks, then, part.contacts, before, part.least_approach / 2);
      again = !report.settled && !std::exchange(deform, true);
    } while (again || break_bonds(part, report) || add_soon(then, before + report.jump, times, first));
    result_.friction_loss += report.friction_loss;
    result_.normal_loss += report.normal_loss;
    result_.support_work += report.support_work;
    result_.limited = result_.limited || report.limited;
    result_.settled = result_.settled && report.settled;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (first[c]) {
        result_.hit[c] = 1;
        ++result_.n_hits;
        meetings_[c] = {};
      }
    jump(report.jump, rigid_velocities(blocks, then, report.jump), times);
    return true;
  }

  /// Adds to the meetings that come first those of the same blocks that come with these velocities too, while
  /// waves cross the blocks: where the first ones part them before, as where a round block lands, the others
  /// do not take place. False: none.
  bool add_soon(const BlockState& then, const VectorXd& velocity, const std::vector<double>& times,
                std::vector<char>& first) const {
    bool any = false;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact& contact = contacts[c];
      if (first[c] || !std::isfinite(meetings_[c].time) || !takes_part(contact, times)) continue;
      const GapAndSlip rates = rates_at(then, contact);
      const double gap = rates.gap - contact.history.gap_offset,
                   approach = -contact.motion.change_along(rates.by_gap, velocity);
      if (approach <= 0 || gap > approach * impact_duration(blocks, contact)) continue;
      first[c] = 1;
      any = true;
    }
    return any;
  }

  struct Colliding {
    std::vector<ImpactContact> contacts;
    std::vector<std::size_t> indices;
    double least_approach = inf;
  };
  /// Lets bonds go that would have to bear more than their strength; false: none does.
  bool break_bonds(const Colliding& part, const JumpReport& report) {
    bool any = false;
    for (std::size_t k = 0; k < part.contacts.size(); ++k) {
      const Contact& contact = contacts[part.indices[k]];
      if (!part.contacts[k].bonded ||
          bond_bears(contact, part.contacts[k], report.impulses[k], impact_duration(blocks, contact)))
        continue;
      yields_[part.indices[k]] = 1;
      any = true;
    }
    return any;
  }
  /// \param[in] deform  whether what bears follows the deformation of its blocks; of whole steps impacts end
  /// its approach too, where they can
  Colliding find_colliding(const BlockState& then, const VectorXd& before, bool deform,
                           const std::vector<double>& times, const std::vector<char>& first) const {
    Colliding found;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact& contact = contacts[c];
      if (!takes_part(contact, times)) continue;
      const GapAndSlip rates = rates_at(then, contact);
      if (!first[c] && !touches(c, rates)) continue;
      const bool bounces = first[c] && meetings_[c].approach > 2 * blocks.gravity.norm() * dt;
      found.indices.push_back(c);
      ImpactContact& part = found.contacts.emplace_back(ImpactContact{
          .gap = contact.motion.form(rates.by_gap), .slip = contact.motion.form(rates.by_slip)});
      if (deform && bears(contact)) {  // what presses blocks deforms them as fast: that is no approach
        part.gap_rate = std::max(part.gap.change(deformation_), -part.gap.change(before));
        part.slip_rate = part.slip.change(deformation_);
      }
      part.friction = contact.law.friction;
      if (contact.law.friction_law)
        part.friction_law = [&law = *contact.law.friction_law, dt = dt](double impulse) {
          return dt * law(impulse / dt);
        };
      part.restitution = bounces ? *restitution_of(properties, contact.pair, rule) : 0;
      part.bonded =
          contact.has_bond() && !yields_[c] && !(contact.law.ductile && is_slipping(contact.history.state));
      if (first[c])
        found.least_approach = std::min(found.least_approach, least_approach(blocks, contact, dt));
    }
    return found;
  }

  /// Gives the blocks this jump at these times: they start as if they had moved so from the start.
  void jump(const VectorXd& at_impact, const std::vector<RigidVelocity>& jumps, std::vector<double> times) {
    VectorXd jump = at_impact;
    if (!result_.changes()) result_.jump = result_.shift = VectorXd::Zero(jump.size());
    hit_now_.assign(blocks.n_blocks(), 0);
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      const Block& block = blocks.block(b);
      const Range& u = block.unknowns();
      auto of_block = u.of(jump);
      hit_now_[b] = !of_block.isZero(0);
      if (!std::isfinite(times[b])) times[b] = 0;  // no jump either
      if (hit_now_[b]) last_[b] = times[b];
      if (blocks.is_free(b)) of_block = as_velocity(block, start_, jumps[b]);
      u.of(result_.shift) -= times[b] * of_block;
      times[b] = -times[b];
    }
    start_ = carried(blocks, start_, jump, VectorXd::Zero(jump.size()), times);
    VectorXd& going_on = start_.carried_dt > 0 ? start_.carried : start_.velocity;
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      if (!blocks.is_free(b)) continue;
      const Mat2 turn = turned_by(times[b] * jumps[b].angular);
      for (VectorXd* velocity : {&going_on, &jump, &result_.jump})
        turn_about_centre(blocks.block(b), start_, turn, *velocity);
    }
    going_on += jump;
    result_.jump += jump;
  }

  const std::vector<char>& forced_;
  BlockState start_;  ///< as if the blocks had moved with their present velocities all the time
  VectorXd velocity_, acceleration_;
  VectorXd deformation_;              ///< of `velocity_`, what is not rigid in blocks that bear
  VectorXd forces_;                   ///< of loads, then of the contacts of the last step too
  std::vector<RigidVelocity> rigid_;  ///< of `velocity_`
  std::vector<Vec2> centres_;         ///< of all blocks at `start_`, from the model's origin
  std::vector<char> bears_;           ///< blocks with contacts that bear
  std::vector<double> last_;          ///< impact of each block, s
  std::vector<Meeting> meetings_;
  std::vector<char> hit_now_, yields_;  ///< blocks that the last impact hit; bonds that one breaks
  StepImpact result_;
};

}  // namespace

double least_approach(const BlockSystem& blocks, const Contact& contact, double dt) {
  return std::max(0.1 * blocks.gravity.norm() * dt, round_off_speed(contact, dt));
}

std::optional<double> restitution_of(const ContactProperties& properties, const VertexEdge& pair,
                                     const StepRule& rule) {
  const JointStrength& joint = properties.strength(pair);
  return joint.restitution || rule.has_half_steps() || joint.is_compliant() ? joint.restitution : 0;
}

StepImpact predict_impact(const ImpactStep& step, const std::vector<char>& forced) {
  assert(step.dt > 0 && (forced.empty() || forced.size() == step.contacts.size()));
  Flight flight(step, forced);
  StepImpact impact = flight.follow();
  if (!impact.changes()) return impact;
  flight.find_acceleration_before(impact);
  return impact;
}

}  // namespace ddacontact
