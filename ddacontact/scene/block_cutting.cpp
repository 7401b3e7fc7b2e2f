#include <ddacontact/scene/block_cutting.hpp>

#include <ddacontact/scene/outline_check.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/convex_parts.hpp>
#include <polyfem/geometry/outline_cleaning.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace ddacontact {

namespace {

/// An outline, and the vertices of the block that each of its own stands for.
struct Part {
  Points outline;
  std::vector<std::vector<int>> sources;
};

/// Counter-clockwise, with the numbers of the scene.
Part whole(const Points& vertices) {
  const Index n = vertices.cols();
  const bool turned = polyfem::signed_area(vertices) < 0;
  Part part{vertices, {}};
  if (turned) part.outline = vertices.rowwise().reverse();
  for (Index k = 0; k < n; ++k) part.sources.push_back({static_cast<int>(turned ? n - 1 - k : k)});
  return part;
}

Part cleaned(const Part& part, const polyfem::CleanedOutline& result) {
  Part rest{result.polygon, {}};
  for (const std::vector<int>& merged : result.sources) {
    std::vector<int>& sources = rest.sources.emplace_back();
    for (const int k : merged) sources.insert(sources.end(), part.sources[k].begin(), part.sources[k].end());
  }
  return rest;
}

Part with_corners(const Part& part, const std::vector<int>& corners) {
  Part result{Points(2, static_cast<Index>(corners.size())), {}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    result.outline.col(static_cast<Index>(k)) = part.outline.col(corners[k]);
    result.sources.push_back(part.sources[corners[k]]);
  }
  return result;
}

/// One part at least.
std::vector<Part> parts_of(const Points& vertices, const CutOptions& options, CutCounts& counts) {
  Part part = whole(vertices);
  if (options.shortest_edge > 0) {
    const double shortest = options.shortest_edge * std::sqrt(polyfem::signed_area(part.outline));
    const auto result = polyfem::merge_ends_of_short_edges(part.outline, shortest);
    counts.short_edges += result.n_removed;
    part = cleaned(part, result);
  }
  if (options.drop_straight) {
    const auto result = polyfem::drop_straight_vertices(part.outline, scene_format::straight_turn);
    counts.straight_vertices += result.n_removed;
    part = cleaned(part, result);
  }
  if (!options.convex) return {part};
  std::vector<Part> parts;
  for (const std::vector<int>& corners : polyfem::convex_parts(part.outline, scene_format::straight_turn))
    parts.push_back(with_corners(part, corners));
  return parts;
}

bool contains_any(const std::vector<int>& list, const std::vector<int>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](int k) { return std::find(list.begin(), list.end(), k) != list.end(); });
}

BlockDescription block_of(const Part& part, const BlockDescription& block) {
  BlockDescription result = block;
  result.vertices = part.outline;
  const Vec2 arm =
      polyfem::area_moments(part.outline).centroid - polyfem::area_moments(block.vertices).centroid;
  result.velocity += block.angular_velocity * Vec2(-arm.y(), arm.x());
  result.stress += block.stress_gradient * arm.y();
  result.fixed_vertices.clear();
  for (std::size_t k = 0; k < part.sources.size(); ++k)
    if (contains_any(block.fixed_vertices, part.sources[k]))
      result.fixed_vertices.push_back(static_cast<int>(k));
  return result;
}

int count_lost_holds(const BlockDescription& block, const std::vector<Part>& parts) {
  return static_cast<int>(
      std::count_if(block.fixed_vertices.begin(), block.fixed_vertices.end(), [&](int held) {
        return std::none_of(parts.begin(), parts.end(), [&](const Part& part) {
          return std::any_of(part.sources.begin(), part.sources.end(),
                             [&](const std::vector<int>& sources) { return contains_any(sources, {held}); });
        });
      }));
}

/// The parts of some blocks.
std::vector<int> all_parts(const std::vector<int>& blocks, const std::vector<std::vector<int>>& parts) {
  std::vector<int> all;
  for (const int block : blocks) all.insert(all.end(), parts[block].begin(), parts[block].end());
  return all;
}

void require_own_names(const Scene& scene) {
  std::set<std::string> names;
  for (const BlockDescription& block : scene.blocks)
    if (!block.name.empty() && !names.insert(block.name).second)
      throw Error("two blocks would be called \"" + block.name + "\" (rename the block that has this name)");
}

}  // namespace

Scene cut_blocks(const Scene& scene, const CutOptions& options, CutCounts& counts) {
  Scene result = scene;
  result.blocks.clear();
  result.supports.clear();
  result.loads.clear();
  result.monitors.clear();
  std::vector<std::vector<int>> parts_of_block;
  for (const BlockDescription& block : scene.blocks) {
    const std::vector<Part> parts = parts_of(block.vertices, options, counts);
    std::vector<int>& indices = parts_of_block.emplace_back(parts.size());
    std::iota(indices.begin(), indices.end(), static_cast<int>(result.blocks.size()));
    if (parts.size() == 1 && parts[0].outline.cols() == block.vertices.cols()) {
      result.blocks.push_back(block);
      continue;
    }
    counts.split += parts.size() > 1;
    counts.lost_holds += count_lost_holds(block, parts);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      result.blocks.push_back(block_of(parts[k], block));
      if (parts.size() > 1 && !block.name.empty()) result.blocks.back().name += '.' + std::to_string(k + 1);
    }
  }
  for (StageDescription& stage : result.stages) {
    stage.removed = all_parts(stage.removed, parts_of_block);
    stage.added = all_parts(stage.added, parts_of_block);
    stage.loads.clear();
  }
  require_own_names(result);
  return result;
}

}  // namespace ddacontact
