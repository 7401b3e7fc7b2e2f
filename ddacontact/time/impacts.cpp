#include <ddacontact/time/impacts.hpp>

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/contact/contact_place.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <ddacontact/time/waves.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The first t in [0, dt] with g + v t + a t^2 / 2 <= 0; infinity: none.
double first_touch(double g, double v, double a, double dt) {
  if (g <= 0) return v < 0 ? 0 : infinity;
  const double discriminant = v * v - 2 * a * g;
  if (discriminant < 0) return infinity;
  // The smaller root that lies ahead, without cancellation.
  const double t = 2 * g / (-v + std::sqrt(discriminant));
  return t >= 0 && t <= dt ? t : infinity;
}

/// The same of a circle that passes a corner in a straight line: it turns away from it.
double first_touch(const Vec2& apart, const Vec2& velocity, double radius, double dt) {
  const double towards = -apart.dot(velocity), outside = apart.squaredNorm() - radius * radius,
               discriminant = towards * towards - velocity.squaredNorm() * outside;
  if (towards <= 0 || discriminant < 0) return infinity;
  if (outside <= 0) return 0;
  const double t = outside / (towards + std::sqrt(discriminant));
  return t <= dt ? t : infinity;
}

/// The displacements of all unknowns of blocks that go on as rigid bodies, each for its own time.
BlockState carried(const BlockSystem& blocks, const BlockState& state, const VectorXd& velocity,
                   const VectorXd& acceleration, const std::vector<double>& times) {
  BlockState later = state;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!std::isfinite(times[b]) || !blocks.is_free(b)) continue;
    const Block& block = blocks.block(b);
    const RigidVelocity v = rigid_velocity(block, velocity), a = rigid_velocity(block, acceleration);
    const Vec2 shift = times[b] * v.linear + times[b] * times[b] / 2 * a.linear,
               centre = block.moments().centroid;
    const Mat2 R = Eigen::Rotation2Dd(times[b] * v.angular).toRotationMatrix();
    auto places = later.position.middleCols(block.places().first, block.places().count);
    places = ((R * (places.colwise() - centre)).colwise() + (centre + shift)).eval();
    if (later.coordinates.size() == 0) continue;
    auto s = later.coordinates.segment<3>(block.coordinates().first);
    s.head<2>() = (centre + shift + R * (Vec2(s.head<2>()) - centre)).eval();
    s[2] += times[b] * v.angular;
  }
  return later;
}

VectorXd as_velocity(const Block& block, const RigidVelocity& v) {
  return block.rigid_modes() * Vec3(v.linear.x(), v.linear.y(), v.angular);
}

/// Turns the velocities of a free block's nodes about its centre; that of the centre stays.
void turn_about_centre(const Block& block, const Mat2& turn, VectorXd& velocity) {
  const Range& u = block.unknowns();
  auto v = velocity.segment(u.first, u.count);
  const VectorXd of_centre = block.translations() * rigid_velocity(block, velocity).linear;
  v -= of_centre;
  for (Index k = 0; k + 1 < v.size(); k += 2) v.segment<2>(k) = (turn * v.segment<2>(k)).eval();
  v += of_centre;
}

}  // namespace

double least_approach(const BlockSystem& blocks, const Contact& contact, double dt) {
  return std::max(0.1 * blocks.gravity.norm() * dt, 1e-9 * contact.size / dt);
}

std::optional<double> restitution_of(const ContactProperties& properties, const VertexEdge& pair,
                                     const StepRule& rule) {
  const std::optional<double>& given = properties.strength(pair).restitution;
  return given || rule.has_half_steps() ? given : 0;
}

StepImpact foresee_impact(BlockSystem& blocks, const BlockState& state, const ContactProperties& properties,
                          const std::vector<Contact>& contacts, const StepRule& rule,
                          const VectorXd& velocity_before, double dt, const std::vector<char>& also) {
  VectorXd velocity = velocity_before;
  StepImpact result;
  result.hit.assign(contacts.size(), 0);

  std::vector<bool> touches(blocks.n_blocks(), false);
  for (const Contact& contact : contacts)
    if (contact.closed()) touches[contact.pair.vertex_block] = touches[contact.pair.edge_block] = true;
  VectorXd acceleration = VectorXd::Zero(velocity.size());
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (touches[b] || !blocks.is_free(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    acceleration.segment(u.first, u.count) = blocks.block(b).translations() * blocks.gravity;
  }

  if (rule.has_half_steps()) velocity += state.carried_dt / 2 * acceleration;

  std::vector<double> times(blocks.n_blocks(), infinity);
  std::vector<double> approaches(contacts.size(), 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!restitution_of(properties, contact.pair, rule)) continue;
    const VertexEdgeForm gap = contact.first_gap();
    const double rate = contact.motion.change_along(gap.gradient, velocity),
                 growth = contact.motion.change_along(gap.gradient, acceleration),
                 gap_now = gap.constant - contact.history.gap_offset;
    if (contact.closed() && (rule.has_half_steps() || carries_waves(blocks, contact, dt))) continue;
    const bool near = contact.closed() || gap_now <= contact.length_tolerance();
    const MovingVertexEdge& motion = contact.motion;
    Vec2 apart = Vec2::Zero(), passing = Vec2::Zero();
    if (motion.is_at_corner()) {
      apart = from_corner(motion.places(), *motion.rounding);
      passing = from_corner(motion.moved(velocity), *motion.rounding);
    }
    double time = motion.is_at_corner() && !near ? first_touch(apart, passing, motion.rounding->radius, dt)
                                                 : first_touch(near ? 0 : gap_now, rate, growth, dt);
    if (!std::isfinite(time) && !also.empty() && also[c])
      time = rate < 0 ? std::min(dt, std::max(gap_now, 0.0) / -rate) : infinity;
    if (!std::isfinite(time)) continue;
    const VertexEdgeForm slip = contact.first_slip();
    const double slip_then = slip.constant + time * contact.motion.change_along(slip.gradient, velocity);
    if (!contact.closed() && !contact.is_on_edge(slip_then)) continue;
    approaches[c] =
        motion.is_at_corner() ? -(apart + time * passing).normalized().dot(passing) : -(rate + time * growth);
    if (approaches[c] <= least_approach(blocks, contact, dt)) continue;
    result.hit[c] = 1;
    ++result.n_hits;
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block}) times[b] = std::min(times[b], time);
  }
  if (result.n_hits == 0) return result;

  // Everyone collides where he is when he is hit, turned by then.
  std::vector<RigidVelocity> at_start;
  for (int b = 0; b < blocks.n_blocks(); ++b) at_start.push_back(rigid_velocity(blocks.block(b), velocity));
  const BlockState then = carried(blocks, state, velocity, acceleration, times);
  blocks.prepare(then);
  VectorXd before = velocity;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!std::isfinite(times[b]) || !blocks.is_free(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    before.segment(u.first, u.count) =
        as_velocity(blocks.block(b), at_start[b]) + times[b] * acceleration.segment(u.first, u.count);
  }
  std::vector<ImpactContact> taking_part;
  double least = infinity;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!result.hit[c] && !contact.closed()) continue;
    if (!result.hit[c] && !rule.has_half_steps() && carries_waves(blocks, contact, dt)) continue;
    const GapAndSlip rates =
        contact.motion.rates_at(place_of(blocks, then, contact.pair), contact.history.lock);
    const bool bounces = result.hit[c] && approaches[c] > 2 * blocks.gravity.norm() * dt;
    taking_part.push_back({contact.motion.form(rates.by_gap), contact.motion.form(rates.by_slip),
                           shear_bound(contact.law, 1, false),
                           bounces ? *restitution_of(properties, contact.pair, rule) : 0,
                           contact.has_bond()});
    if (result.hit[c]) least = std::min(least, least_approach(blocks, contact, dt));
  }
  const JumpReport report = impact(blocks, taking_part, before, {.least_approach = least / 2});
  result.friction_loss = report.friction_loss;
  result.normal_loss = report.normal_loss;
  result.limited = report.limited;
  result.settled = report.settled;

  double earliest = infinity;
  for (double t : times) earliest = std::min(earliest, t);
  for (double& time : times)
    if (!std::isfinite(time)) time = earliest;
  std::vector<RigidVelocity> jumps;
  for (int b = 0; b < blocks.n_blocks(); ++b) jumps.push_back(rigid_velocity(blocks.block(b), report.jump));
  blocks.prepare(state);
  result.jump = report.jump;
  result.shift.resize(report.jump.size());
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    auto jump = result.jump.segment(u.first, u.count);
    if (blocks.is_free(b)) jump = as_velocity(block, jumps[b]);
    result.shift.segment(u.first, u.count) = -times[b] * jump;
  }
  for (double& time : times) time = -time;
  result.start = carried(blocks, state, result.jump, VectorXd::Zero(result.jump.size()), times);
  VectorXd& going_on = state.carried_dt > 0 ? result.start.carried : result.start.velocity;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!blocks.is_free(b)) continue;
    const Mat2 turn = Eigen::Rotation2Dd(times[b] * jumps[b].angular).toRotationMatrix();
    turn_about_centre(blocks.block(b), turn, going_on);
    turn_about_centre(blocks.block(b), turn, result.jump);
  }
  going_on += result.jump;
  return result;
}

}  // namespace ddacontact
