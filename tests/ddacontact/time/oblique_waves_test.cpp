// What a quiet side gives back of plane waves at 30 degrees to its normal.
#include <tests/ddacontact/simple_scenes.hpp>

#include <array>
#include <complex>
#include <map>

using namespace support;

namespace {

constexpr double stiffness_of_ground = 4e9, density_of_ground = 2500;

/// A block of square cells of 1 m; its right side may be quiet.
Scene ground(int width, int height, bool quiet) {
  Scene scene;
  scene.analysis.time_step = 0.5 / std::sqrt(1.2 * stiffness_of_ground / density_of_ground);
  scene.analysis.gravity = Vec2(0, 0);
  scene.analysis.scheme = Scheme::central_difference;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", density_of_ground, stiffness_of_ground, 0.25}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * stiffness_of_ground;
  scene.contact.tangential_stiffness = 16 * stiffness_of_ground;
  BlockDescription one = block(rectangle(0, 0, width, height));
  one.model = BlockModel::mesh;
  one.mesh.kind = ddacontact::CellKind::quads;
  one.mesh.cells = width * height;
  scene.blocks = {one};
  if (quiet) scene.quiet_boundaries = {{Vec2(width, 0), Vec2(width, height), {{0, 1}}, {}}};
  return scene;
}

/// Plane waves about one direction under a Gaussian bell. Velocities are the gradient of a potential, of a
/// shear wave turned by 90 degrees. Without displacement at the start half of the energy goes there, half
/// back.
struct Packet {
  bool is_shear;
  double angle, length;  ///< to the x axis, radians; of a wave, m
  Vec2 centre;

  Vec2 velocity(const Vec2& x) const {
    const Vec2 way(std::cos(angle), std::sin(angle)), from = x - centre;
    const double number = 2 * std::numbers::pi / length, phase = number * way.dot(from);
    const Vec2 gradient = std::exp(-from.squaredNorm() / (2 * length * length)) *
                          (std::cos(phase) * number * way - std::sin(phase) / (length * length) * from);
    return 1e-4 * (is_shear ? Vec2(-gradient.y(), gradient.x()) : gradient);
  }
};

/// The ground after a packet has gone a way through it.
struct Shaken {
  BuiltScene built;
  double energy_at_start;

  Shaken(const Scene& scene, const Packet& packet, double duration) : built(build(scene)) {
    Stepper& stepper = *built.stepper;
    const Points at = stepper.blocks().positions(stepper.state());
    StepRecord record = stepper.record();
    for (Index p = 0; p < at.cols(); ++p)
      record.state.velocity.segment<2>(2 * p) = packet.velocity(at.col(p));
    energy_at_start = stepper.blocks().block(0).kinetic_energy(record.state.velocity);
    stepper.restore(std::move(record));
    run(stepper, static_cast<int>(std::lround(duration / scene.analysis.time_step)));
  }

  const BlockSystem& blocks() const { return built.stepper->blocks(); }
  const BlockState& state() const { return built.stepper->state(); }
};

std::pair<long, long> on_grid(const Vec2& x) {
  return {std::lround(x.x()), std::lround(x.y())};
}

/// Of the field that one has more than the other has at the same nodes, kinetic and elastic.
double energy_of_difference(const Shaken& small, const Shaken& large) {
  std::map<std::pair<long, long>, int> nodes_of_large;
  const Points far = large.blocks().reference(), near = small.blocks().reference();
  for (Index p = 0; p < far.cols(); ++p) nodes_of_large[on_grid(far.col(p))] = static_cast<int>(p);
  const Points moved_far = large.blocks().displacements(large.state()),
               moved = small.blocks().displacements(small.state());
  BlockState difference = small.blocks().initial_state();
  for (Index p = 0; p < near.cols(); ++p) {
    const int q = nodes_of_large.at(on_grid(near.col(p)));
    difference.position.col(p) += moved.col(p) - moved_far.col(q);
    difference.velocity.segment<2>(2 * p) =
        small.state().velocity.segment<2>(2 * p) - large.state().velocity.segment<2>(2 * q);
  }
  const Block& block = small.blocks().block(0);
  return block.kinetic_energy(difference.velocity) + block.elastic_energy(difference);
}

/// The parts of a plane wave's energy that dashpots rho c_p, rho c_s on the side x = 0 give back as pressure
/// and as shear waves. With sin(shear) = s sin(pressure), s = c_s / c_p, amplitudes P and S follow from the
/// balance of normal and shear traction,
///     (cos 2b + cos a) P - (s sin 2b + sin b) S = cos a - cos 2b   or  s sin 2b - sin b
///     (s sin 2a + sin a) P + (cos 2b + cos b) S = s sin 2a - sin a  or  cos 2b - cos b
/// for a pressure wave at a or a shear wave at b, and energies from the flow through the side.
std::array<double, 2> returned(double s, bool is_shear, double angle) {
  using Number = std::complex<double>;
  const Number a = is_shear ? std::asin(Number(std::sin(angle) / s)) : angle;
  const double b = is_shear ? angle : std::asin(s * std::sin(angle));
  Eigen::Matrix2cd balance;
  balance << std::cos(2 * b) + std::cos(a), -(s * std::sin(2 * b) + std::sin(b)),
      s * std::sin(2. * a) + std::sin(a), std::cos(2 * b) + std::cos(b);
  const Eigen::Vector2cd coming(
      is_shear ? s * std::sin(2 * b) - std::sin(b) : std::cos(a) - std::cos(2 * b),
      is_shear ? std::cos(2 * b) - std::cos(b) : s * std::sin(2. * a) - std::sin(a));
  const Eigen::Vector2cd going = balance.inverse() * coming;
  const double flow_P = std::cos(a).real(), flow_S = s * std::cos(b), flow = is_shear ? flow_S : flow_P;
  return {std::norm(going[0]) * flow_P / flow, std::norm(going[1]) * flow_S / flow};
}

/// What comes back of a packet at 30 degrees, of the energy that comes in.
double measured_return(bool is_shear, double speed) {
  constexpr double length = 8, radius = 20;  // of a wave, of the packet
  const double angle = radians(30), way = radius / std::cos(angle) + radius;
  const Packet packet{is_shear, angle, length, {26, 24}};
  const int width = 46, height = 72, beyond = 26;
  const Shaken quiet(ground(width, height, true), packet, way / speed),
      endless(ground(width + beyond, height, false), packet, way / speed);
  return energy_of_difference(quiet, endless) / (endless.energy_at_start / 2);
}

}  // namespace

/// By the formula, for plane waves: less than 1 % of pressure waves, less than 5 % of shear waves.
TEST(ObliqueWaves, DashpotsReturnLittleAt30Degrees) {
  for (const double poisson : {0.0, 0.1, 0.2, 0.25, 0.3, 0.4}) {
    const double s = std::sqrt((1 - 2 * poisson) / (2 - 2 * poisson));
    for (const bool is_shear : {false, true}) {
      const std::array<double, 2> back = returned(s, is_shear, radians(30));
      EXPECT_LT(back[0] + back[1], is_shear ? 0.05 : 0.007);
      const std::array<double, 2> straight = returned(s, is_shear, 0);
      EXPECT_LT(straight[0] + straight[1], 1e-30);
    }
  }
}

/// Within half a per cent of the incoming energy: the packet has waves of some degrees more and less too, and
/// its waves are eight cells long.
TEST(ObliqueWaves, AQuietSideReturnsWhatItsDashpotsDo) {
  const Mat3 D = build(ground(1, 1, false)).stepper->blocks().block(0).material().elasticity;
  const double pressure = std::sqrt(D(0, 0) / density_of_ground),
               shear = std::sqrt(D(2, 2) / density_of_ground);
  for (const bool is_shear : {false, true}) {
    const double part = measured_return(is_shear, is_shear ? shear : pressure);
    const std::array<double, 2> back = returned(shear / pressure, is_shear, radians(30));
    EXPECT_LT(part, 0.05) << is_shear;
    EXPECT_NEAR(part, back[0] + back[1], 0.005) << is_shear;
  }
}
