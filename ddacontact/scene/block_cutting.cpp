#include <ddacontact/scene/block_cutting.hpp>

#include <ddacontact/scene/outline_check.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/convex_parts.hpp>
#include <polyfem/geometry/outline_cleaning.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace ddacontact {

namespace {

constexpr int of_materials = -1;  // the joint of an edge that names none

/// Old edges may lie beside a new one by so much, over its length: more than vertices left out of it bend.
constexpr double beside_edge = 1e-7;

/// An outline, the vertices of the block that each of its own stands for, and the joints of its edges; these
/// are empty where the block names none.
struct Part {
  Points outline;
  std::vector<std::vector<int>> sources;
  std::vector<int> joints;
};

/// Counter-clockwise, with the numbers of the scene.
Part whole(const BlockDescription& block) {
  const Index n = block.vertices.cols();
  const bool turned = polyfem::signed_area(block.vertices) < 0;
  Part part{block.vertices, {}, block.edge_joints};
  if (turned) part.outline = block.vertices.rowwise().reverse();
  for (Index k = 0; k < n; ++k) part.sources.push_back({static_cast<int>(turned ? n - 1 - k : k)});
  // Edge k of the other orientation, from its vertex k, ends where edge n - 2 - k begins.
  if (turned && !part.joints.empty()) std::reverse(part.joints.begin(), part.joints.end() - 1);
  return part;
}

/// Of an edge: the length that lies on edges of each joint.
using Shares = std::map<int, double>;

/// The one of the greatest length.
int joint_of(const Shares& shares, CutCounts& counts) {
  counts.mixed_edges += shares.size() > 1;
  const auto greatest = std::ranges::max_element(shares, {}, &Shares::value_type::second);
  return greatest == shares.end() ? of_materials : greatest->first;
}

/// Those of the edges between the vertices that are left; merged ones have lost the edges between them.
std::vector<int> joints_of(const Part& part, const polyfem::CleanedOutline& result, CutCounts& counts) {
  if (part.joints.empty()) return {};
  const int n = static_cast<int>(part.joints.size());
  std::vector<int> vertex(part.joints.size(), -1);  // of the result, of each that is left
  for (std::size_t k = 0; k < result.sources.size(); ++k)
    for (const int source : result.sources[k]) vertex[source] = static_cast<int>(k);
  std::vector<Shares> shares(result.sources.size());
  const int first = result.sources.front().front();
  for (int k = first, edge = 0; k < first + n; ++k) {
    const int from = k % n, to = (k + 1) % n;
    if (vertex[from] >= 0) edge = vertex[from];
    if (vertex[to] != edge || vertex[from] < 0)
      shares[edge][part.joints[from]] += (part.outline.col(to) - part.outline.col(from)).norm();
  }
  std::vector<int> joints;
  for (const Shares& of_edge : shares) joints.push_back(joint_of(of_edge, counts));
  return joints;
}

Part cleaned(const Part& part, const polyfem::CleanedOutline& result, CutCounts& counts) {
  Part rest{result.polygon, {}, joints_of(part, result, counts)};
  for (const std::vector<int>& merged : result.sources) {
    std::vector<int>& sources = rest.sources.emplace_back();
    for (const int k : merged) sources.insert(sources.end(), part.sources[k].begin(), part.sources[k].end());
  }
  return rest;
}

/// Of an edge within a block: what lies on edges of the block, and on none, which is a cut.
Shares shares_of(const Vec2& a, const Vec2& b, const Part& part) {
  const double length = (b - a).norm();
  const Vec2 along = (b - a) / length, across(-along.y(), along.x());
  Shares shares;
  double cut = length;
  for (std::size_t k = 0; k < part.joints.size(); ++k) {
    const Vec2 from = part.outline.col(static_cast<Index>(k)) - a,
               to = part.outline.col(static_cast<Index>((k + 1) % part.joints.size())) - a;
    if (std::max(std::abs(across.dot(from)), std::abs(across.dot(to))) > beside_edge * length) continue;
    const double common = std::min(along.dot(to), length) - std::max(along.dot(from), 0.);
    if (common <= beside_edge * length) continue;
    shares[part.joints[k]] += common;
    cut -= common;
  }
  if (cut > beside_edge * length) shares[of_materials] += cut;
  return shares;
}

Part with_corners(const Part& part, const std::vector<int>& corners, CutCounts& counts) {
  Part result{Points(2, static_cast<Index>(corners.size())), {}, {}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    result.outline.col(static_cast<Index>(k)) = part.outline.col(corners[k]);
    result.sources.push_back(part.sources[corners[k]]);
    if (part.joints.empty()) continue;
    const Vec2 a = part.outline.col(corners[k]), b = part.outline.col(corners[(k + 1) % corners.size()]);
    result.joints.push_back(joint_of(shares_of(a, b, part), counts));
  }
  return result;
}

/// One part at least.
std::vector<Part> parts_of(const BlockDescription& block, const CutOptions& options, CutCounts& counts) {
  Part part = whole(block);
  if (options.shortest_edge > 0) {
    const double shortest = options.shortest_edge * std::sqrt(polyfem::signed_area(part.outline));
    const auto result = polyfem::merge_ends_of_short_edges(part.outline, shortest);
    counts.short_edges += result.n_removed;
    part = cleaned(part, result, counts);
  }
  if (options.drop_straight) {
    const auto result = polyfem::drop_straight_vertices(part.outline, scene_format::straight_turn);
    counts.straight_vertices += result.n_removed;
    part = cleaned(part, result, counts);
  }
  if (!options.convex) return {part};
  std::vector<Part> parts;
  for (const std::vector<int>& corners : polyfem::convex_parts(part.outline, scene_format::straight_turn))
    parts.push_back(with_corners(part, corners, counts));
  return parts;
}

bool contains_any(const std::vector<int>& list, const std::vector<int>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](int k) { return std::find(list.begin(), list.end(), k) != list.end(); });
}

BlockDescription block_of(const Part& part, const BlockDescription& block) {
  BlockDescription result = block;
  result.vertices = part.outline;
  result.edge_joints = part.joints;
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
    const std::vector<Part> parts = parts_of(block, options, counts);
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
