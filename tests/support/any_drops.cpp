#include "any_drops.hpp"

#include "overlap_area.hpp"
#include "random_shapes.hpp"

#include <ddacontact/detection/separation.hpp>
#include <ddacontact/scene/builder.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <array>

namespace support {

namespace {

using namespace ddacontact;

constexpr double degree = std::numbers::pi / 180;
/// Inner width and height of the box, m, and how thick its walls are; the largest blocks are of radius 0.5.
constexpr double width = 4, height = 4, wall = 1;

Points rectangle(double left, double bottom, double right, double top) {
  return points({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

Points from_list(const std::vector<Vec2>& vertices) {
  Points polygon(2, static_cast<Index>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) polygon.col(static_cast<Index>(k)) = vertices[k];
  return polygon;
}

class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {
    scene_.analysis.time_step = log_between(2e-3, 1e-2);
    scene_.analysis.steps = 60 + static_cast<int>(between(0, 60));
    const double young = log_between(1e8, 1e10);
    scene_.contact.normal_stiffness = young * log_between(1, 100);
    scene_.contact.tangential_stiffness = scene_.contact.normal_stiffness / 2.5;
    scene_.materials = {{"rock", 2500, young, between(0, 0.4)}};
    Joint joint;
    joint.name = "joint";
    joint.friction_angle = chance(0.15) ? 0 : between(0, 45);
    if (!chance(0.5)) joint.restitution = between(0, 0.5);
    scene_.joints = {joint};
  }

  Scene draw(Ground ground) {
    hold(rectangle(-wall, height, width + wall, height + wall));
    if (ground != Ground::vessel) {
      hold(rectangle(-wall, 0, 0, height));
      hold(rectangle(width, 0, width + wall, height));
    }
    switch (ground) {
      case Ground::floor:
        hold(rectangle(-wall, -wall, width + wall, 0));
        break;
      case Ground::ramp: {
        hold(rectangle(-wall, -wall, width + wall, 0));
        const double run = between(1, width), rise = run * std::tan(between(10, 45) * degree);
        hold(points({{0, 0}, {run, 0}, {0, std::min(rise, 2.5)}}));
        break;
      }
      case Ground::notches:
        hold(notched_floor());
        break;
      case Ground::vessel:
        hold(vessel());
        break;
    }
    const int n = 2 + static_cast<int>(between(0, 5));
    for (int k = 0; k < n; ++k) place_block();
    return scene_;
  }

 private:
  double between(double low, double high) { return uniform(low, high, random_); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool chance(double probability) { return between(0, 1) < probability; }

  static BlockModel model_of(const Points& outline) {
    constexpr double two_degrees = 0.035;
    return polyfem::find_non_convex_corner(outline, two_degrees) ? BlockModel::mean_value
                                                                 : BlockModel::wachspress;
  }

  BlockDescription& add(const Points& outline) {
    BlockDescription block;
    block.vertices = outline;
    block.model = model_of(outline);
    scene_.blocks.push_back(block);
    return scene_.blocks.back();
  }
  void hold(const Points& outline) { add(outline).fixed = true; }

  Points notched_floor() {
    std::vector<Vec2> top{{0, 0}};
    for (double x = between(0.05, 0.5); x < width - 0.1;) {
      const double wide = log_between(0.05, 1), depth = between(0.1, 0.8);
      if (x + wide > width - 0.05) break;
      top.emplace_back(x, 0);
      if (chance(0.5)) {
        top.emplace_back(x, -depth);
        top.emplace_back(x + wide, -depth);
      } else {
        top.emplace_back(x + between(0.2, 0.8) * wide, -depth);
      }
      top.emplace_back(x + wide, 0);
      x += wide + log_between(0.05, 0.8);
    }
    top.emplace_back(width, 0);
    std::vector<Vec2> outline{{-wall, -wall - 0.5}, {width + wall, -wall - 0.5}, {width + wall, 0}};
    outline.insert(outline.end(), top.rbegin(), top.rend());
    outline.emplace_back(-wall, 0);
    return from_list(outline);
  }

  Points vessel() {
    const double left = between(0.2, 1.5), right = between(0.2, 1.5), deep = between(0.5, 2);
    return points({{-wall, -wall},
                   {width + wall, -wall},
                   {width + wall, height},
                   {width, height},
                   {width, deep},
                   {width - right, 0},
                   {left, 0},
                   {0, deep},
                   {0, height},
                   {-wall, height}});
  }

  /// Somewhere in the box, mostly low, apart from all that is there; not at all when there is no room.
  void place_block() {
    const double radius = 0.5 * log_between(1.0 / 30, 1);
    const Points shape = radius * random_shape(random_);
    for (int attempt = 0; attempt < 200; ++attempt) {
      const double angle = between(0, 2 * std::numbers::pi);
      polyfem::Mat2 R;
      R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      const Vec2 centre(between(0, width), height * std::pow(between(0, 1), 1.5));
      const Points outline = (R * shape).colwise() + centre;
      const double gap = 1e-3 * radius;
      if (std::any_of(scene_.blocks.begin(), scene_.blocks.end(), [&](const BlockDescription& other) {
            return separation(outline, other.vertices) < gap;
          }))
        continue;
      BlockDescription& block = add(outline);
      if (chance(1.0 / 7)) block.model = BlockModel::affine;
      block.velocity = between(0, 3) * random_direction(random_) - Vec2(0, between(0, 3));
      if (chance(0.6)) block.angular_velocity = between(-10, 10);
      return;
    }
  }

  std::mt19937 random_;
  Scene scene_;
};

/// `origin`: of the stepper's places in the scene.
void evaluate(const Stepper& stepper, const Vec2& origin, AnyDrop& drop) {
  const BlockSystem& blocks = stepper.blocks();
  const BlockState& state = stepper.state();
  const auto fail = [&](int a, int b, const std::string& what) {
    if (!drop.failure.empty()) return;
    drop.failure = what + ", blocks " + blocks.names[a] + " and " + blocks.names[b] + " at step " +
                   std::to_string(stepper.counts().steps);
  };
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!blocks.is_movable(b)) continue;
    const Points outline = blocks.outline_from(state, b, b);
    const Vec2 centre = polyfem::area_moments(outline).centroid + state.origin.col(b) + origin;
    if (centre.x() < 0 || centre.x() > width || centre.y() < -wall || centre.y() > height) {
      drop.passed = true;
      fail(b, b, "out of the box");
    }
    for (int a = 0; a < blocks.n_blocks(); ++a) {
      if (a == b || (blocks.is_movable(a) && a > b)) continue;
      const Points p = blocks.outline_from(state, a, a), q = blocks.outline_from(state, b, a);
      if ((p.rowwise().minCoeff().array() > q.rowwise().maxCoeff().array()).any() ||
          (q.rowwise().minCoeff().array() > p.rowwise().maxCoeff().array()).any())
        continue;
      const double smaller = std::min(blocks.block(a).reference_area(), blocks.block(b).reference_area());
      const double overlap = overlap_area(p, q) / smaller;
      drop.overlap = std::max(drop.overlap, overlap);
      if (overlap > overlap_limit) fail(a, b, "overlap " + std::to_string(overlap));
      if (overlap > 0.5) drop.passed = true;
    }
  }
}

}  // namespace

std::string name_of(Ground ground) {
  constexpr std::array names{"floor", "ramp", "notches", "vessel"};
  return names[static_cast<std::size_t>(ground)];
}

Ground ground_of(std::uint64_t seed) {
  return static_cast<Ground>(seed % n_grounds);
}

Scene any_drop(std::uint64_t seed) {
  return Drawing(seed).draw(ground_of(seed));
}

AnyDrop run_any_drop(std::uint64_t seed) {
  const Scene scene = any_drop(seed);
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const Energy& energy = stepper.energy().now;
  const auto mechanical = [&] { return energy.kinetic + energy.elastic + energy.gravity; };
  AnyDrop drop;
  double before = mechanical(), largest = energy.kinetic;
  for (int k = 0; k < scene.analysis.steps; ++k) {
    if (!stepper.step()) {
      drop.stopped_by = stepper.stop_reason();
      break;
    }
    const double gain = mechanical() - before;
    largest = std::max(largest, energy.kinetic);
    drop.rises += gain > energy_rise * largest;
    drop.rise = std::max(drop.rise, gain / largest);
    before = mechanical();
    evaluate(stepper, built.labels.origin, drop);
  }
  for (const BlockDescription& block : scene.blocks) drop.blocks += !block.fixed;
  const StepCounts& counts = stepper.counts();
  drop.steps = counts.steps;
  drop.substeps = counts.substeps;
  drop.rejected = counts.rejected;
  drop.overlap_rejections = counts.overlap_rejections;
  return drop;
}

}  // namespace support
