#include <tests/support/limit_structures.hpp>

#include <glpk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

namespace support {

using namespace ddacontact;

namespace {

constexpr double gravity = 9.8, density = 2500, young = 350e9, right_angle = std::numbers::pi / 2;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double area_of(const Points& p) {
  double twice = 0;
  for (Index k = 0; k < p.cols(); ++k) twice += cross(p.col(k), p.col((k + 1) % p.cols()));
  return twice / 2;
}

Vec2 centroid_of(const Points& p) {
  Vec2 sum(0, 0);
  for (Index k = 0; k < p.cols(); ++k) {
    const Vec2 a = p.col(k), b = p.col((k + 1) % p.cols());
    sum += cross(a, b) * (a + b);
  }
  return sum / (6 * area_of(p));
}

Scene static_scene(double friction) {
  Scene scene;
  scene.analysis.mode = Mode::statics;
  scene.analysis.gravity = Vec2(0, -gravity);
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"stone", density, young, 0.2}};
  scene.joints = {{"joint", std::atan(friction) * 90 / right_angle, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * young;
  scene.contact.tangential_stiffness = 16 * young;
  return scene;
}

BlockDescription stone(const Points& outline, bool fixed = false) {
  BlockDescription block;
  block.vertices = outline;
  block.fixed = fixed;
  block.model = BlockModel::automatic;
  return block;
}

/// Equal voussoirs between radial joints, from the angle `from` to `to`, counter-clockwise from x.
struct Arch {
  int n_voussoirs;
  double radius, thickness, from, to;

  Vec2 point(double joint, double of_radius) const {
    const double angle = from + (to - from) * joint / n_voussoirs;
    return of_radius * Vec2(std::cos(angle), std::sin(angle));
  }
  double inner() const { return radius - thickness / 2; }
  double outer() const { return radius + thickness / 2; }
  /// Those before 0 and from n_voussoirs on are the springers.
  Points voussoir(int k) const {
    Points p(2, 4);
    p << point(k, inner()), point(k, outer()), point(k + 1, outer()), point(k + 1, inner());
    return p;
  }
};

/// A force on a voussoir.
struct Force {
  int voussoir;
  Vec2 at, force;
};

/// value + slope . (thrust x, thrust y, moment, factor)
struct Linear {
  double value = 0;
  std::array<double, 4> slope{};
};

Linear sum(const Linear& a, double times, const Linear& b) {
  Linear result = a;
  result.value += times * b.value;
  for (int k = 0; k < 4; ++k) result.slope[k] += times * b.slope[k];
  return result;
}

/// The largest factor with all of them >= 0; none: there is no such factor, or no largest one.
std::optional<double> largest_factor(const std::vector<Linear>& conditions) {
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(), glp_delete_prob);
  glp_prob* lp = problem.get();
  glp_set_obj_dir(lp, GLP_MAX);
  glp_add_cols(lp, 4);
  for (int k = 1; k <= 4; ++k) glp_set_col_bnds(lp, k, k == 4 ? GLP_LO : GLP_FR, 0, 0);
  glp_set_obj_coef(lp, 4, 1);
  glp_add_rows(lp, static_cast<int>(conditions.size()));
  for (std::size_t row = 0; row < conditions.size(); ++row) {
    const int columns[] = {0, 1, 2, 3, 4};
    double values[5] = {0};
    std::copy(conditions[row].slope.begin(), conditions[row].slope.end(), values + 1);
    glp_set_mat_row(lp, static_cast<int>(row) + 1, 4, columns, values);
    glp_set_row_bnds(lp, static_cast<int>(row) + 1, GLP_LO, -conditions[row].value, 0);
  }
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  if (glp_simplex(lp, &options) != 0 || glp_get_status(lp) != GLP_OPT) return std::nullopt;
  return glp_get_obj_val(lp);
}

/// Lengths over the radius, forces over the weight of a voussoir.
std::optional<double> arch_limit(const Arch& arch, double friction, const std::vector<Force>& loads) {
  const double weight = density * gravity * area_of(arch.voussoir(0));
  std::vector<Linear> conditions;
  // What the part before a joint exerts on the part after it, and its moment about the middle of the joint.
  for (int joint = 0; joint <= arch.n_voussoirs; ++joint) {
    const Vec2 middle = arch.point(joint, 1);
    Linear x{0, {1, 0, 0, 0}}, y{0, {0, 1, 0, 0}}, moment{0, {0, 0, 1, 0}};
    const Vec2 arm = arch.point(0, 1) - middle;
    moment = sum(sum(moment, arm.x(), y), -arm.y(), x);
    for (int k = 0; k < joint; ++k) {
      y.value -= 1;
      moment.value += cross(centroid_of(arch.voussoir(k)) / arch.radius - middle, Vec2(0, -1));
      for (const Force& load : loads) {
        if (load.voussoir != k) continue;
        x.slope[3] += load.force.x() / weight;
        y.slope[3] += load.force.y() / weight;
        moment.slope[3] += cross(load.at / arch.radius - middle, load.force / weight);
      }
    }
    const Vec2 outwards = middle, along(-middle.y(), middle.x());
    const Linear normal = sum(sum({}, along.x(), x), along.y(), y),
                 shear = sum(sum({}, outwards.x(), x), outwards.y(), y);
    const double half = arch.thickness / 2 / arch.radius;
    for (const double sign : {1., -1.}) {
      conditions.push_back(sum(sum({}, half, normal), sign, moment));
      conditions.push_back(sum(sum({}, friction, normal), sign, shear));
    }
  }
  return largest_factor(conditions);
}

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0);
  }
  int below(int n) { return static_cast<int>(generator_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937 generator_;
};

std::optional<LimitStructure> random_arch(Random& random) {
  const double rise = random.below(2) ? 0 : random.between(0, 0.5);
  const Arch arch{5 + random.below(11), random.between(3, 12), 0, rise, 2 * right_angle - rise};
  Arch thick = arch;
  thick.thickness = arch.radius * random.between(0.11, 0.3);
  const double friction = 0.8;
  const int kind = random.below(3), loaded = random.below(arch.n_voussoirs);
  const double area = area_of(thick.voussoir(0)), weight = density * gravity * area;
  std::vector<Force> forces;
  LimitStructure structure;
  structure.scene = static_scene(friction);
  for (int k = -1; k <= arch.n_voussoirs; ++k)
    structure.scene.blocks.push_back(stone(thick.voussoir(k), k < 0 || k == arch.n_voussoirs));
  const auto add_body = [&](int k, const Vec2& per_volume) {
    forces.push_back({k, centroid_of(thick.voussoir(k)), area * per_volume});
    structure.scene.loads.push_back(
        {Load::Kind::body, k + 1, Vec2(0, 0), 0, 0, {TimeFunction::Kind::constant, per_volume, {}}});
  };
  if (kind == 0) {
    const Vec2 at = (thick.point(loaded, thick.outer()) + thick.point(loaded + 1, thick.outer())) / 2;
    forces.push_back({loaded, at, Vec2(0, -weight)});
    structure.scene.loads.push_back(
        {Load::Kind::point, loaded + 1, at, 0, 0, {TimeFunction::Kind::constant, Vec2(0, -weight), {}}});
  }
  for (int k = 0; k < arch.n_voussoirs; ++k) {
    if (kind == 1) add_body(k, density * gravity * Vec2(1, 0));
    if (kind == 2 && 2 * k < arch.n_voussoirs) add_body(k, density * gravity * Vec2(0, -1));
  }
  const auto limit = arch_limit(thick, friction, forces), rough = arch_limit(thick, 1e3, forces);
  if (!limit || !rough || *limit < 0.02 || *rough - *limit > 1e-6 * *limit) return std::nullopt;
  structure.limit = *limit;
  structure.name = "arch of " + std::to_string(arch.n_voussoirs) + ", thickness " +
                   std::to_string(thick.thickness / arch.radius) + " R, load " + std::to_string(kind) +
                   ", limit " + std::to_string(*limit);
  return structure;
}

LimitStructure random_pillar(Random& random) {
  const int n = 1 + random.below(6);
  const double width = random.between(0.5, 2), height = width * random.between(0.5, 5),
               friction = random.between(0.3, 0.9);
  LimitStructure structure;
  structure.scene = static_scene(friction);
  const auto box = [](double x, double y, double w, double h) {
    Points p(2, 4);
    p << x, x + w, x + w, x, y, y, y + h, y + h;
    return p;
  };
  structure.scene.blocks.push_back(stone(box(-5, -1, 10 + width, 1), true));
  for (int k = 0; k < n; ++k) {
    structure.scene.blocks.push_back(
        stone(box(0, height * k / n, width, height * (k + 1) / n - height * k / n)));
    structure.scene.loads.push_back({Load::Kind::body,
                                     k + 1,
                                     Vec2(0, 0),
                                     0,
                                     0,
                                     {TimeFunction::Kind::constant, density * gravity * Vec2(1, 0), {}}});
  }
  structure.limit = std::min(friction, width / height);
  structure.name = "pillar of " + std::to_string(n) + ", height " + std::to_string(height / width) +
                   " b, mu " + std::to_string(friction);
  return structure;
}

}  // namespace

Scene with_loads(const LimitStructure& structure, double factor) {
  Scene scene = structure.scene;
  for (Load& load : scene.loads) load.force.value *= factor;
  return scene;
}

std::vector<LimitStructure> limit_structures(int number, unsigned seed) {
  Random random(seed);
  std::vector<LimitStructure> structures;
  while (static_cast<int>(structures.size()) < number) {
    if (structures.size() % 2 == 1) {
      structures.push_back(random_pillar(random));
    } else if (auto arch = random_arch(random)) {
      structures.push_back(std::move(*arch));
    }
  }
  return structures;
}

}  // namespace support
