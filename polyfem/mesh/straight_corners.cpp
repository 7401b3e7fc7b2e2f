#include <polyfem/mesh/straight_corners.hpp>

#include <vector>

namespace polyfem {

namespace {

constexpr int most_rounds = 20;
constexpr double steps[] = {0.25, 0.05, 0.01};

Vec2 middle_of_neighbours(const MeshEditor& mesh, int v) {
  Vec2 sum = Vec2::Zero();
  const std::vector<int> neighbours = mesh.neighbours(v);
  for (const int w : neighbours) sum += mesh.vertex(w);
  return sum / static_cast<double>(neighbours.size());
}

bool improve(MeshEditor& mesh, int v) {
  const Vec2 old = mesh.vertex(v), way = middle_of_neighbours(mesh, v) - old;
  for (const double step : steps)
    if (mesh.move(v, old + step * way)) return true;
  return false;
}

}  // namespace

void bend_straight_corners(MeshEditor& mesh, double wanted_turn) {
  bool improved = true;
  for (int round = 0; improved && round < most_rounds; ++round) {
    improved = false;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      if (mesh.turn(c) >= wanted_turn) continue;
      for (const int v : mesh.cell(c)) improved = improve(mesh, v) || improved;
    }
  }
}

}  // namespace polyfem
