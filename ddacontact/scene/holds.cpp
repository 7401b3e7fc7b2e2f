#include <ddacontact/scene/holds.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ddacontact {

std::vector<Holds> collect_holds(const Scene& scene, const std::vector<PlacedBlock>& placed) {
  std::vector<Holds> holds;
  const auto ours = [&](int block, std::vector<int> vertices) {
    for (int& v : vertices) v = placed[block].ours(v);
    return vertices;
  };
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b) {
    const BlockDescription& block = scene.blocks[b];
    Holds& of_block = holds.emplace_back(block.vertices.cols());
    std::vector<int> fixed = ours(b, block.fixed_vertices);
    if (block.fixed) {
      fixed.resize(block.vertices.cols());
      std::iota(fixed.begin(), fixed.end(), 0);
    }
    for (int axis = 0; axis < 2; ++axis) of_block.hold(fixed, axis, {});
  }
  for (const Support& support : scene.supports) {
    const std::vector<int> prescribed = ours(support.block, support.vertices);
    if (support.fix_x) holds[support.block].hold(prescribed, 0, support.displacement);
    if (support.fix_y) holds[support.block].hold(prescribed, 1, support.displacement);
  }
  return holds;
}

void check_followed(const VertexHolds& holds, const PointsRef& outline, const std::array<int, 3>& control,
                    int axis, const Scene& scene, int block) {
  const Vec2 origin = outline.col(control[0]);
  const Vec2 p = outline.col(control[1]) - origin, q = outline.col(control[2]) - origin;
  for (std::size_t v = 0; v < holds.size(); ++v) {
    if (!holds[v][axis] || std::find(control.begin(), control.end(), v) != control.end()) continue;
    const Vec2 r = outline.col(static_cast<Index>(v)) - origin;
    const double a = cross(r, q) / cross(p, q), b = cross(p, r) / cross(p, q);
    const int n_steps = scene.n_steps();
    for (int step = 0; step <= n_steps; ++step) {
      const double time = step * scene.end_time() / n_steps;
      const auto at = [&](int vertex) { return (*holds[vertex][axis]).at(time, scene.end_time())[axis]; };
      const double told = (1 - a - b) * at(control[0]) + a * at(control[1]) + b * at(control[2]);
      const double asked = at(static_cast<int>(v));
      if (std::abs(told - asked) > 1e-9 * (std::abs(told) + std::abs(asked)))
        throw Error(
            "the supports of block \"" + scene.block_name(block) +
            "\" ask for displacements that its affine model cannot follow (hold at most three vertices, or "
            "use model = \"wachspress\")");
    }
  }
}

}  // namespace ddacontact
