#include "random_scenes.hpp"

#include "random_polygon.hpp"

#include <polyfem/mesh/voronoi.hpp>

#include <algorithm>
#include <array>

namespace support {

namespace {

using namespace ddacontact;

constexpr double degree = std::numbers::pi / 180;

Points rectangle(double width, double height, const Vec2& corner = Vec2::Zero()) {
  Points p(2, 4);
  p << 0, width, width, 0, 0, 0, height, height;
  return p.colwise() + corner;
}

Points turned(const Points& polygon, double angle) {
  polyfem::Mat2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R * polygon;
}

class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {
    scene_.analysis.time_step = log_between(1e-3, 2e-2);
    scene_.analysis.steps = 30 + static_cast<int>(between(0, 70));
    scene_.analysis.kinematics = Kinematics::corotational;
    scene_.analysis.scheme = Scheme::decaying;
    scene_.analysis.cutting_factor = 0.5;
    scene_.contact.method = ContactMethod::staged;
    scene_.contact.penetration_tolerance = 1e-6;
    const double young = log_between(1e7, 1e11);
    scene_.contact.normal_stiffness = young * log_between(1, 1e3);
    scene_.contact.tangential_stiffness = scene_.contact.normal_stiffness / 2.5;
    scene_.materials = {{"rock", 2500, young, between(0, 0.4)}};
    Joint joint;
    joint.name = "joint";
    joint.friction_angle = chance(0.15) ? 0 : std::atan(between(0, 1)) / degree;
    joint.restitution = chance(0.5) ? 0 : between(0, 1);
    scene_.joints = {joint};
  }

  Scene draw(DropKind kind) {
    const double slope = between(5, 45) * degree;
    switch (kind) {
      case DropKind::floor:
        floor(0);
        throw_blocks(1 + static_cast<int>(between(0, 8)), 0);
        break;
      case DropKind::ramp:
        floor(slope);
        throw_blocks(1 + static_cast<int>(between(0, 6)), slope);
        break;
      case DropKind::wedge:
        wedge();
        break;
      case DropKind::swarm:
        scene_.analysis.gravity.setZero();
        throw_blocks(2 + static_cast<int>(between(0, 7)), 0);
        break;
      case DropKind::wall:
        wall();
        break;
      case DropKind::stack:
        stack();
        break;
      case DropKind::pile:
        floor(0);
        throw_blocks(30, 0);
        break;
      case DropKind::arch:
        arch();
        break;
      case DropKind::assembly:
        assembly(slope / 1.5);
        break;
    }
    return scene_;
  }

 private:
  double between(double low, double high) { return uniform(low, high, random_); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool chance(double probability) { return between(0, 1) < probability; }
  double duration() const { return scene_.end_time(); }

  BlockDescription& add(const Points& outline, bool fixed = false) {
    BlockDescription block;
    block.vertices = outline;
    block.fixed = fixed;
    scene_.blocks.push_back(block);
    return scene_.blocks.back();
  }

  /// A speed at which a block of this size goes by up to twice its size during the run; seldom faster.
  Vec2 velocity(double size) {
    const double travel = chance(0.1) ? 8 : 2;
    return std::min(20.0, between(0, travel) * size / duration()) * random_direction(random_);
  }
  double spin() { return (chance(0.5) ? 1 : -1) * log_between(1e-3, 0.2) / scene_.analysis.time_step; }
  void set_moving(BlockDescription& block, double size, bool slowly = false) {
    block.velocity = velocity(size) * (slowly ? 0.3 : 1);
    if (chance(0.5)) block.angular_velocity = slowly ? between(-1, 1) : std::clamp(spin(), -20.0, 20.0);
  }

  /// Of unit size about the origin.
  Points shape() {
    const double kind = between(0, 1);
    if (kind < 0.3) return centred_to_unit_size(rectangle(1, between(0.2, 1)));
    if (kind < 0.5) return regular_polygon(3 + static_cast<int>(between(0, 6)));
    return random_convex_polygon(3 + static_cast<int>(between(0, 6)), random_);
  }

  void floor(double slope) { add(turned(rectangle(400, 20, Vec2(-200, -20)), slope), true); }

  /// Rows of blocks one above the other, each in its circle, on a floor of that slope.
  void throw_blocks(int n, double slope) {
    const double smallest = chance(0.3) ? 1.0 / 30 : 0.3;
    const int columns = 1 + static_cast<int>(between(0, std::sqrt(n) + 1));
    double height = 0;
    for (int first = 0; first < n; first += columns) {
      double x = between(-1, 1), top = height;
      for (int k = first; k < std::min(n, first + columns); ++k) {
        const double radius = 0.5 * log_between(smallest, 1), gap = radius * log_between(1e-3, 0.5);
        const Vec2 centre(x + radius, height + radius + gap);
        add_at(turned(radius * shape(), between(0, 2 * std::numbers::pi)), turned(centre, slope), radius);
        x += 2 * radius + gap;
        top = std::max(top, height + 2 * radius + gap);
      }
      height = top;
    }
  }
  void add_at(const Points& polygon, const Vec2& centre, double radius) {
    set_moving(add(polygon.colwise() + centre), radius);
    scene_.blocks.back().velocity.y() -= 0.5 * velocity(radius).norm();
  }

  void wedge() {
    const double left = between(20, 70) * degree, right = between(20, 70) * degree;
    add(turned(rectangle(100, 20, Vec2(0, -20)), right), true);
    add(turned(rectangle(100, 20, Vec2(-100, -20)), -left), true);
    const int n = 1 + static_cast<int>(between(0, 5));
    double height = 0;
    for (int k = 0; k < n; ++k) {
      const double radius = 0.5 * log_between(0.1, 1);
      // The circle that touches both planes, or the one below it.
      const double touching = radius / std::cos(std::max(left, right));
      height = std::max(height + radius, 1.05 * touching + 0.01);
      const double tilt = (right - left) / 2;
      add_at(turned(radius * shape(), between(0, 2 * std::numbers::pi)),
             height * Vec2(-std::sin(tilt), std::cos(tilt)) * 1.5, radius);
      height += radius;
    }
  }

  void bricks(int rows, int columns) {
    for (int row = 0; row < rows; ++row) {
      const double shift = row % 2 == 0 ? 0 : -0.5;
      for (int column = 0; column < columns + row % 2; ++column) {
        const bool half = row % 2 == 1 && (column == 0 || column == columns);
        const double x = column == 0 ? 0 : column + shift;
        add(rectangle(half ? 0.5 : 1, 0.5, Vec2(x, 0.5 * row)));
      }
    }
  }

  void wall() {
    floor(0);
    const int rows = 2 + static_cast<int>(between(0, 4)), columns = 1 + static_cast<int>(between(0, 3));
    bricks(rows, columns);
    const double radius = log_between(0.1, 0.8), gap = radius * log_between(1e-3, 0.5);
    const Vec2 centre(-radius - gap, std::max(radius * 1.01, between(0, 0.5 * rows)));
    BlockDescription& hits =
        add(turned(radius * shape(), between(0, 2 * std::numbers::pi)).colwise() + centre);
    hits.velocity = Vec2(std::min(20.0, between(0.5, 6) / duration()), 0);
    hits.angular_velocity = between(-5, 5);
  }

  void stack() {
    floor(0);
    const int n = 2 + static_cast<int>(between(0, 6));
    double height = 0;
    for (int k = 0; k < n; ++k) {
      const double width = log_between(0.2, 2), thickness = width * between(0.2, 1);
      BlockDescription& block =
          add(rectangle(width, thickness, Vec2(-width / 2 + between(-0.1, 0.1), height)));
      if (chance(0.5)) set_moving(block, width, true);
      height += thickness;
    }
  }

  void arch() {
    const int n = 3 + static_cast<int>(between(0, 7));
    const double thickness = between(0.08, 0.5), step = std::numbers::pi / n;
    floor(0);
    for (int k = 0; k < n; ++k) {
      const double a = step * k, b = step * (k + 1), inner = 2 - thickness, outer = 2 + thickness;
      Points p(2, 4);
      p << outer * std::cos(a), outer * std::cos(b), inner * std::cos(b), inner * std::cos(a),
          outer * std::sin(a), outer * std::sin(b), inner * std::sin(b), inner * std::sin(a);
      p.row(1) = p.row(1).cwiseMax(0);
      BlockDescription& block = add(p);
      if (chance(0.2)) set_moving(block, thickness, true);
    }
  }

  void assembly(double slope) {
    floor(slope);
    const double width = between(1, 4), height = between(1, 3);
    polyfem::VoronoiOptions options;
    options.n_cells = 3 + static_cast<int>(between(0, 20));
    options.seed = random_();
    options.lloyd_steps = static_cast<int>(between(0, 4));
    const polyfem::PolygonMesh cells = polyfem::voronoi(rectangle(width, height), options);
    for (int c = 0; c < cells.n_cells(); ++c) {
      BlockDescription& block = add(turned(cells.outline(c), slope));
      if (chance(0.2)) set_moving(block, std::sqrt(width * height / options.n_cells), true);
    }
    if (chance(0.3)) {
      scene_.joints[0].cohesion = log_between(1e2, 1e5);
      scene_.joints[0].tensile_strength = scene_.joints[0].cohesion / 2;
    }
  }

  std::mt19937 random_;
  Scene scene_;
};

}  // namespace

std::string name_of(DropKind kind) {
  constexpr std::array names{"floor", "ramp", "wedge", "swarm", "wall", "stack", "pile", "arch", "assembly"};
  return names[static_cast<std::size_t>(kind)];
}

DropKind drop_kind(std::uint64_t seed) {
  return static_cast<DropKind>(seed % n_drop_kinds);
}

Scene random_drop(std::uint64_t seed) {
  return Drawing(seed).draw(drop_kind(seed));
}

}  // namespace support
