#include <ddacontact/time/free_flight.hpp>

#include <ddacontact/block/motion_shape.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

double first_touch(double g, double v, double a, double dt) {
  assert(dt >= 0);
  if (g <= 0) return v < 0 ? 0 : inf;
  const double discriminant = v * v - 2 * a * g;
  if (discriminant < 0) return inf;
  // The smaller root that lies ahead, without cancellation.
  const double t = 2 * g / (-v + std::sqrt(discriminant));
  return t >= 0 && t <= dt ? t : inf;
}

double first_touch(const Vec2& apart, const Vec2& velocity, double radius, double dt) {
  const double towards = -apart.dot(velocity), outside = apart.squaredNorm() - radius * radius,
               discriminant = towards * towards - velocity.squaredNorm() * outside;
  if (towards <= 0 || discriminant < 0) return inf;
  if (outside <= 0) return 0;
  const double t = outside / (towards + std::sqrt(discriminant));
  return t <= dt ? t : inf;
}

Vec2 off_straight_line(const Vec2& arm, double angle) {
  return turn_less_one(angle) * arm - angle * Vec2(-arm.y(), arm.x());
}

BlockState carried(const BlockSystem& blocks, const BlockState& state, const VectorXd& velocity,
                   const VectorXd& acceleration, const std::vector<double>& times) {
  BlockState later = state;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!std::isfinite(times[b]) || !blocks.is_free(b)) continue;
    const Block& block = blocks.block(b);
    const RigidVelocity v = rigid_velocity(block, state, velocity),
                        a = rigid_velocity(block, state, acceleration);
    const double half_square = times[b] * times[b] / 2,
                 angle = times[b] * v.angular + half_square * a.angular;
    const Vec2 shift = times[b] * v.linear + half_square * a.linear, centre = block.moments(state).centroid;
    const Mat2 R = turned_by(angle);
    auto points = block.points().columns_of(later.position);
    points = ((R * (points.colwise() - centre)).colwise() + (centre + shift)).eval();
    if (later.coordinates.size() == 0) continue;
    auto s = later.coordinates.segment<BlockState::n_rigid>(block.coordinates().first);
    s.head<2>() = (centre + shift + R * (Vec2(s.head<2>()) - centre)).eval();
    s[2] += angle;
  }
  return later;
}

std::vector<RigidVelocity> rigid_velocities(const BlockSystem& blocks, const BlockState& state,
                                            const VectorXd& velocity) {
  std::vector<RigidVelocity> of_blocks;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    of_blocks.push_back(rigid_velocity(blocks.block(b), state, velocity));
  return of_blocks;
}

void turn_about_centre(const Block& block, const BlockState& state, const Mat2& turn, VectorXd& velocity) {
  const Range& u = block.unknowns();
  auto v = u.of(velocity);
  const VectorXd of_centre = block.translations() * rigid_velocity(block, state, velocity).linear;
  v -= of_centre;
  for (Index k = 0; k + 1 < v.size(); k += 2) v.segment<2>(k) = (turn * v.segment<2>(k)).eval();
  v += of_centre;
}

}  // namespace ddacontact
