#include "random_arches_walls.hpp"

#include "limit_analysis.hpp"
#include "polygons.hpp"
#include "random_polygon.hpp"
#include "rigid_rock.hpp"

#include <array>

namespace support {

namespace {

using namespace ddacontact;

class MasonryDrawing {
 public:
  explicit MasonryDrawing(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {
    masonry_.kind = static_cast<Masonry>(seed % n_masonry_kinds);
  }

  LoadedMasonry draw() {
    while (!try_once()) {
    }
    return masonry_;
  }

 private:
  double between(double low, double high) { return uniform(low, high, random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  bool try_once() {
    masonry_.scene = rigid_rock();
    masonry_.friction = between(0.6, 1);
    masonry_.scene.joints[0].friction_angle = std::atan(masonry_.friction) * 180 / std::numbers::pi;
    const bool is_arch = masonry_.kind == Masonry::arch_point || masonry_.kind == Masonry::arch_body;
    is_arch ? arch() : wall();
    masonry_.kind == Masonry::arch_point ? point_load() : body_force();
    const RigidBlocks blocks = rigid_blocks(masonry_.scene);
    const std::optional<double> limit = largest_factor(blocks, masonry_.friction),
                                rough = largest_factor(blocks, 10 * masonry_.friction);
    if (!limit || !rough || *limit < 0.05 || *limit > 1 || *rough > 1.001 * *limit) return false;
    masonry_.scene = loaded(masonry_, *limit);
    return true;
  }

  /// Voussoirs from the right springing on; the first and the last are fixed.
  void arch() {
    const int n = whole(5, 15);
    const double half = between(45, 90) * std::numbers::pi / 180, radius = 5,
                 thickness = radius * between(0.1, 0.3);
    const double step = 2 * half / n, first = std::numbers::pi / 2 - half;
    for (int k = -1; k <= n; ++k) {
      const auto at = [&](double r, int joint) {
        const double angle = first + joint * step;
        return Vec2(r * std::cos(angle), r * std::sin(angle));
      };
      const double inner = radius - thickness / 2, outer = radius + thickness / 2;
      Points voussoir(2, 4);
      voussoir << at(inner, k), at(outer, k), at(outer, k + 1), at(inner, k + 1);
      masonry_.scene.blocks.push_back(rock_block(voussoir, k < 0 || k == n));
    }
  }

  void wall() {
    const int n_courses = whole(2, 10), n_columns = whole(1, 6);
    masonry_.scene.blocks.push_back(rock_block(rectangle(-20, -1, 60, 1), true));
    for (int course = 0; course < n_courses; ++course) {
      const double y = 0.5 * course;
      const bool shifted = masonry_.kind == Masonry::running_bond && course % 2 == 1;
      if (shifted) masonry_.scene.blocks.push_back(rock_block(rectangle(0, y, 0.5, 0.5)));
      for (int k = 0; k < n_columns - shifted; ++k)
        masonry_.scene.blocks.push_back(rock_block(rectangle(k + 0.5 * shifted, y, 1, 0.5)));
      if (shifted) masonry_.scene.blocks.push_back(rock_block(rectangle(n_columns - 0.5, y, 0.5, 0.5)));
    }
  }

  /// Of the weight of all free blocks, in the middle of the back.
  void point_load() {
    double weight = 0;
    for (const BlockDescription& block : masonry_.scene.blocks)
      if (!block.fixed)
        weight += masonry_.scene.materials[0].density * polyfem::signed_area(block.vertices) *
                  masonry_.scene.analysis.gravity.norm();
    const int n_blocks = static_cast<int>(masonry_.scene.blocks.size());
    Load load;
    load.kind = Load::Kind::point;
    load.block = whole(1, n_blocks - 2);
    const Points& voussoir = masonry_.scene.blocks[static_cast<std::size_t>(load.block)].vertices;
    load.at = (voussoir.col(1) + voussoir.col(2)) / 2;
    load.force.value = Vec2(0, -weight);
    masonry_.scene.loads.push_back(load);
  }

  /// To the right, of the weight.
  void body_force() {
    for (std::size_t b = 0; b < masonry_.scene.blocks.size(); ++b) {
      if (masonry_.scene.blocks[b].fixed) continue;
      Load load;
      load.kind = Load::Kind::body;
      load.block = static_cast<int>(b);
      load.force.value =
          Vec2(masonry_.scene.materials[0].density * masonry_.scene.analysis.gravity.norm(), 0);
      masonry_.scene.loads.push_back(load);
    }
  }

  std::mt19937 random_;
  LoadedMasonry masonry_;
};

}  // namespace

std::string name_of(Masonry kind) {
  constexpr std::array names{"arch, point load", "arch, body force", "running bond", "stack bond"};
  return names[static_cast<std::size_t>(kind)];
}

LoadedMasonry random_masonry(std::uint64_t seed) {
  return MasonryDrawing(seed).draw();
}

Scene loaded(const LoadedMasonry& masonry, double factor) {
  Scene scene = masonry.scene;
  for (Load& load : scene.loads) load.force.value *= factor;
  return scene;
}

}  // namespace support
