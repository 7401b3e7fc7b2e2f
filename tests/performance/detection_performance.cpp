// How long detection takes: boxes to sorted pairs, and pairs to contacts.
//
//   detection_performance [--benchmark_filter=...]
//
// 1e5 squares in a brick wall, as many at random places with sizes of 1:8, and as many Voronoi cells.
#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/half_width.hpp>
#include <ddacontact/detection/narrow_phase.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>

namespace {

using namespace ddacontact;

constexpr int n_blocks = 100000;
/// How far contacts are looked for, of a block's size.
constexpr double search_margin = 0.02;

struct Blocks {
  std::vector<Points> outlines;
  std::vector<double> reaches, half_widths;
  std::vector<Box> boxes;

  void add(const Points& outline) {
    const double size = std::sqrt(polyfem::signed_area(outline));
    outlines.push_back(outline);
    reaches.push_back(search_margin * size);
    half_widths.push_back(half_width(outline));
    boxes.push_back(bounding_box(outline, search_margin * size));
  }
};

Points square(const Vec2& corner, double side) {
  Points p(2, 4);
  p << 0, side, side, 0, 0, 0, side, side;
  return p.colwise() + corner;
}

Blocks brick_wall() {
  Blocks blocks;
  const int columns = 400;
  for (int k = 0; k < n_blocks; ++k)
    blocks.add(square(Vec2(k % columns + 0.5 * (k / columns % 2), k / columns), 1));
  return blocks;
}

/// Small ones are as frequent as large ones; spread so that one in ten of the area is covered twice.
Blocks of_sizes_one_to_eight() {
  Blocks blocks;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  const double side = 8 * std::sqrt(n_blocks);
  for (int k = 0; k < n_blocks; ++k)
    blocks.add(square(side / 2.5 * Vec2(part(random), part(random)), std::pow(8, part(random))));
  return blocks;
}

Blocks voronoi_cells() {
  Blocks blocks;
  polyfem::VoronoiOptions options;
  options.n_cells = n_blocks;
  options.lloyd_steps = 2;
  const polyfem::PolygonMesh mesh = polyfem::voronoi(square(Vec2(0, 0), 300), options);
  for (int c = 0; c < mesh.n_cells(); ++c) blocks.add(mesh.outline(c));
  return blocks;
}

void broad(benchmark::State& state, const Blocks& blocks) {
  std::size_t n_pairs = 0;
  for (auto _ : state) {
    n_pairs = overlapping_pairs(blocks.boxes).size();
    benchmark::DoNotOptimize(n_pairs);
  }
  state.counters["pairs"] = static_cast<double>(n_pairs);
}

void whole(benchmark::State& state, const Blocks& blocks) {
  std::vector<Box> boxes(blocks.boxes.size());
  std::vector<VertexEdge> contacts;
  std::vector<Choice> choices;
  std::vector<int> n_vertices;
  for (const Points& outline : blocks.outlines) n_vertices.push_back(static_cast<int>(outline.cols()));
  OutlineTable outlines(n_vertices);
  for (auto _ : state) {
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b) {
      outlines.set(b, blocks.outlines[b]);
      const Vec2 margin = Vec2::Constant(blocks.reaches[b]);
      boxes[b] = {outlines[b].box.low - margin, outlines[b].box.high + margin};
    }
    contacts.clear();
    choices.clear();
    for (const auto& [a, b] : overlapping_pairs(boxes)) {
      const double size = std::min(blocks.reaches[a], blocks.reaches[b]) / search_margin;
      const PairLimits limits{blocks.reaches[a] + blocks.reaches[b],
                              std::min(blocks.half_widths[a], blocks.half_widths[b]), 1e-6 * size,
                              1e-4 * size};
      find_contacts({a, blocks.outlines[a]}, outlines[a], {b, blocks.outlines[b]}, outlines[b], limits, {},
                    contacts, choices);
    }
    benchmark::DoNotOptimize(contacts.data());
  }
  state.counters["contacts"] = static_cast<double>(contacts.size());
}

}  // namespace

int main(int n_arguments, char** arguments) {
  benchmark::Initialize(&n_arguments, arguments);
  const std::vector<std::pair<std::string, Blocks>> scenes{
      {"brick wall", brick_wall()}, {"sizes 1:8", of_sizes_one_to_eight()}, {"Voronoi", voronoi_cells()}};
  for (const auto& [name, blocks] : scenes) {
    benchmark::RegisterBenchmark(("pairs/" + name).c_str(), broad, blocks)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("contacts/" + name).c_str(), whole, blocks)->Unit(benchmark::kMillisecond);
  }
  benchmark::RunSpecifiedBenchmarks();
}
