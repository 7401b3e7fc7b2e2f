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
  }
  return later;
}

VectorXd as_velocity(const Block& block, const RigidVelocity& v) {
  return block.rigid_modes() * Vec3(v.linear.x(), v.linear.y(), v.angular);
}

}  // namespace

double least_approach(const BlockSystem& blocks, const Contact& contact, double dt) {
  return std::max(0.1 * blocks.gravity.norm() * dt, 1e-9 * contact.size / dt);
}

StepImpact foresee_impact(BlockSystem& blocks, const BlockState& state, const ContactProperties& properties,
                          const std::vector<Contact>& contacts, const VectorXd& velocity, double dt,
                          const std::vector<char>& also) {
  StepImpact result;
  result.jump = result.jump_path = VectorXd::Zero(velocity.size());
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

  std::vector<double> times(blocks.n_blocks(), infinity);
  std::vector<double> approaches(contacts.size(), 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    const VertexEdgeForm gap = contact.first_gap();
    const double rate = contact.motion.change_along(gap.gradient, velocity),
                 growth = contact.motion.change_along(gap.gradient, acceleration),
                 gap_now = gap.constant - contact.history.gap_offset;
    if (contact.closed() && carries_waves(blocks, contact, dt)) continue;
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
  std::vector<std::size_t> their_contacts;
  double least = infinity;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!result.hit[c] && (!contact.closed() || carries_waves(blocks, contact, dt))) continue;
    const GapAndSlip rates =
        contact.motion.rates_at(place_of(blocks, then, contact.pair), contact.history.lock);
    const bool bounces = result.hit[c] && approaches[c] > 2 * blocks.gravity.norm() * dt;
    taking_part.push_back({contact.motion.form(rates.by_gap), contact.motion.form(rates.by_slip),
                           shear_bound(contact.law, 1, false),
                           bounces ? properties.strength(contact.pair).restitution : 0, contact.has_bond()});
    their_contacts.push_back(c);
    if (result.hit[c]) least = std::min(least, least_approach(blocks, contact, dt));
  }
  const JumpReport report = impact(blocks, taking_part, before, {.least_approach = least / 2});
  result.friction_loss = report.friction_loss;
  result.normal_loss = report.normal_loss;
  result.limited = report.limited;
  result.settled = report.settled;
  const VectorXd after = before + report.jump;
  result.parted.assign(contacts.size(), 0);
  for (std::size_t k = 0; k < taking_part.size(); ++k) {
    const std::size_t c = their_contacts[k];
    result.parted[c] = taking_part[k].gap.change(after) > least_approach(blocks, contacts[c], dt);
  }

  double earliest = infinity;
  for (double t : times) earliest = std::min(earliest, t);
  std::vector<RigidVelocity> jumps;
  for (int b = 0; b < blocks.n_blocks(); ++b) jumps.push_back(rigid_velocity(blocks.block(b), report.jump));
  blocks.prepare(state);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    auto jump = result.jump.segment(u.first, u.count);
    jump = report.jump.segment(u.first, u.count);
    if (blocks.is_free(b)) jump = as_velocity(block, jumps[b]);
    result.jump_path.segment(u.first, u.count) =
        (dt - (std::isfinite(times[b]) ? times[b] : earliest)) * jump;
  }
  return result;
}

}  // namespace ddacontact
