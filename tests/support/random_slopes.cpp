#include "random_slopes.hpp"

#include "convex_cutting.hpp"
#include "random_polygon.hpp"
#include "rigid_rock.hpp"
#include "touching_faces.hpp"

#include <algorithm>
#include <utility>

namespace support {

namespace {

using namespace ddacontact;

constexpr double degree = std::numbers::pi / 180;
constexpr double height = 20;  // m

Vec2 along(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// The angle between two directions of lines, 0 to 90 degrees.
double between_lines(double a, double b) {
  return std::abs(std::remainder(a - b, std::numbers::pi));
}

class SlopeDrawing {
 public:
  SlopeDrawing(std::uint64_t seed, const SlopeSize& size)
      : random_(static_cast<std::mt19937::result_type>(seed)), size_(size) {}

  Scene draw() {
    do try_once();
    while (n_free_ < size_.least || n_free_ > size_.most);
    return scene_;
  }

 private:
  double between(double low, double high) { return uniform(low, high, random_); }
  bool chance(double probability) { return between(0, 1) < probability; }

  void try_once() {
    const double face = between(50, 85) * degree;
    const double out = between(15 * degree, face - 15 * degree);
    double across = 0;
    do across = out + between(50, 130) * degree;
    while (between_lines(across, face) < 15 * degree || between_lines(across, 0) < 15 * degree);
    const double crest = height / std::tan(face), back = crest + between(0.5, 1) * height;
    const double n_wanted = between(size_.least, size_.most);
    area_ = (height * back - height * crest / 2) / n_wanted;
    const double aspect = std::exp(between(std::log(0.5), std::log(2.0)));
    const double angle_between = std::sin(across - out);
    const double layer = std::sqrt(area_ * angle_between * aspect),
                 width = std::sqrt(area_ * angle_between / aspect);
    sliver_ = {1e-2 * area_, 10 * degree};

    const double margin = 0.5 * height;
    std::vector<Points> layers{domain(face, back + margin, -margin)};
    cut_by_set(layers, out, layer);
    const bool shifted = chance(1. / 3);
    std::vector<Points> cells;
    std::vector<Line> joints = set(across, width);
    for (const Points& strip : layers) {
      if (shifted) joints = set(across, width);
      std::vector<Points> pieces{strip};
      for (const Line& joint : joints) pieces = cut(pieces, joint, sliver_);
      cells.insert(cells.end(), pieces.begin(), pieces.end());
    }
    if (chance(0.25)) {
      double third = 0;
      do third = between(0, std::numbers::pi);
      while (between_lines(third, out) < 25 * degree || between_lines(third, across) < 25 * degree);
      cut_by_set(cells, third, 3 * std::max(layer, width));
    }
    merge_vertices(cells, 1e-9 * height);
    make_scene(cells, back);
  }

  /// What lies below the face and the crest, down to `bottom`.
  static Points domain(double face, double back, double bottom) {
    Points outline(2, 4);
    outline << bottom / std::tan(face), back, back, height / std::tan(face),  //
        bottom, bottom, height, height;
    return outline;
  }

  /// Parallel joints at random distances, wide enough for the domain.
  std::vector<Line> set(double angle, double spacing) {
    const Vec2 normal(-std::sin(angle), std::cos(angle));
    std::vector<Line> lines;
    for (double point = -4 * height + between(0, spacing); point < 4 * height;
         point += spacing * between(0.6, 1.4))
      lines.push_back({point * normal, along(angle)});
    return lines;
  }

  void cut_by_set(std::vector<Points>& cells, double angle, double spacing) {
    for (const Line& joint : set(angle, spacing)) cells = cut(cells, joint, sliver_);
  }

  void make_scene(const std::vector<Points>& cells, double back) {
    scene_ = rigid_rock();
    n_free_ = 0;
    std::vector<bool> fixed;
    for (const Points& cell : cells) {
      const Vec2 centroid = polyfem::area_moments(cell).centroid;
      fixed.push_back(centroid.y() < 0 || centroid.x() > back);
      n_free_ += !fixed.back();
    }
    std::vector<bool> beside_free(cells.size(), false);
    const auto note = [&](int one, int other) {
      for (const auto& [block, neighbour] : {std::pair(one, other), std::pair(other, one)})
        if (!fixed[static_cast<std::size_t>(neighbour)]) beside_free[static_cast<std::size_t>(block)] = true;
    };
    const Touching touching = touching_faces(cells);
    for (const ContactPoint& point : touching.points) note(point.one, point.other);
    for (const CornerContact& corner : touching.corners) note(corner.one, corner.other);
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (!fixed[k] || beside_free[k]) scene_.blocks.push_back(rock_block(cells[k], fixed[k]));
  }

  std::mt19937 random_;
  SlopeSize size_;
  double area_ = 0;
  Sliver sliver_;
  Scene scene_;
  int n_free_ = 0;
};

}  // namespace

Scene random_slope(std::uint64_t seed, const SlopeSize& size) {
  return SlopeDrawing(seed, size).draw();
}

Slab random_slab(std::uint64_t seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  Slab slab;
  slab.dip = uniform(15, 50, random) * degree;
  slab.scene = rigid_rock();
  const int n_layers = 1 + static_cast<int>(uniform(0, 4, random)),
            n_columns = 1 + static_cast<int>(uniform(0, 8, random));
  std::vector<double> levels{0}, points{0};
  for (int k = 0; k < n_layers; ++k) levels.push_back(levels.back() + uniform(0.5, 1.5, random));
  const double least_width = 1.3 * levels.back() * std::tan(slab.dip);
  for (int k = 0; k < n_columns; ++k) points.push_back(points.back() + least_width * uniform(1, 2, random));
  // The plane rises to the right; its blocks end beside the columns' joints, not at them.
  Mat2 turn;
  turn << std::cos(slab.dip), -std::sin(slab.dip), std::sin(slab.dip), std::cos(slab.dip);
  const auto add = [&](double from, double to, double low, double high, bool fixed) {
    Points outline(2, 4);
    outline << from, to, to, from, low, low, high, high;
    slab.scene.blocks.push_back(rock_block(turn * outline, fixed));
  };
  const double length = points.back(), room = std::max(length, 10.0);  // m, that it may slide
  const double joint = length * uniform(-0.5, 1, random);
  add(-room, joint, -1, 0, true);
  add(joint, length + 1, -1, 0, true);
  for (std::size_t column = 0; column + 1 < points.size(); ++column)
    for (std::size_t row = 0; row + 1 < levels.size(); ++row)
      add(points[column], points[column + 1], levels[row], levels[row + 1], false);
  return slab;
}

double steepest_dip(const RigidBlocks& blocks) {
  double steepest = 0;
  for (const ContactPoint& point : blocks.touching.points) {
    const auto is_fixed = [&](int block) { return blocks.fixed[static_cast<std::size_t>(block)]; };
    if (is_fixed(point.one) && is_fixed(point.other)) continue;
    const double dip = std::acos(std::min(1.0, std::abs(point.normal.y())));
    if (dip < 90 * degree - 1e-6) steepest = std::max(steepest, dip);
  }
  return steepest;
}

}  // namespace support
