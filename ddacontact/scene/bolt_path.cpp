#include <ddacontact/scene/bolt_path.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

constexpr double nodes_per_bond_length = 6;

double size_of(const BlockDescription& block) {
  return std::sqrt(std::abs(polyfem::signed_area(block.vertices)));
}

/// Where the segment crosses the outline, as parts of its length, with its ends, ascending.
std::vector<double> crossings(const RockBolt& bolt, const Points& polygon) {
  std::vector<double> parts{0, 1};
  const Vec2 along = bolt.to - bolt.from;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 start = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - start;
    const double determinant = cross(along, edge);
    const double part = cross(start - bolt.from, edge) / determinant,
                 of_edge = cross(start - bolt.from, along) / determinant;
    if (std::isfinite(part) && part > 0 && part < 1 && of_edge >= 0 && of_edge <= 1) parts.push_back(part);
  }
  std::ranges::sort(parts);
  return parts;
}

bool may_meet(const RockBolt& bolt, const Points& polygon) {
  return touch({bolt.from.cwiseMin(bolt.to), bolt.from.cwiseMax(bolt.to)}, bounding_box(polygon));
}

}  // namespace

std::vector<int> blocks_at(const Vec2& point, const std::vector<BlockDescription>& blocks) {
  std::vector<int> found;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Box box = bounding_box(blocks[b].vertices);
    if (touch(widened({point, point}, bolt_tolerance * (box.high - box.low).norm()), box) &&
        (polyfem::contains(blocks[b].vertices, point) ||
         scene_format::distance_to_outline(point, blocks[b].vertices) <= bolt_tolerance * size_of(blocks[b])))
      found.push_back(static_cast<int>(b));
  }
  return found;
}

std::vector<BoltPiece> bolt_pieces(const RockBolt& bolt, const std::vector<BlockDescription>& blocks) {
  const Vec2 along = bolt.to - bolt.from;
  const double length = along.norm();
  std::vector<BoltPiece> pieces;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Points& polygon = blocks[b].vertices;
    if (!may_meet(bolt, polygon)) continue;
    const std::vector<double> parts = crossings(bolt, polygon);
    bool goes_on = false;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
      const double from = parts[k] * length, to = parts[k + 1] * length;
      if (to - from <= bolt_tolerance * size_of(blocks[b])) continue;
      const bool inside = polyfem::contains(polygon, bolt.from + (parts[k] + parts[k + 1]) / 2 * along);
      if (inside && goes_on)
        pieces.back().to = to;
      else if (inside)
        pieces.push_back({static_cast<int>(b), from, to});
      goes_on = inside;
    }
  }
  std::ranges::sort(pieces, {}, &BoltPiece::from);
  return pieces;
}

std::vector<BoltNode> bolt_nodes(const RockBolt& bolt, const std::vector<BlockDescription>& blocks) {
  if (bolt.kind == RockBolt::Kind::anchored)
    return {{blocks_at(bolt.from, blocks).front(), bolt.from}, {blocks_at(bolt.to, blocks).front(), bolt.to}};
  const Vec2 along = (bolt.to - bolt.from).normalized();
  const double longest = std::sqrt(bolt.area * bolt.young / bolt.bond_stiffness) / nodes_per_bond_length;
  std::vector<BoltNode> nodes;
  for (const BoltPiece& piece : bolt_pieces(bolt, blocks)) {
    const double n = std::ceil((piece.to - piece.from) / longest), length = (piece.to - piece.from) / n;
    for (int k = 0; k < n; ++k)
      nodes.push_back({piece.block, bolt.from + (piece.from + (k + 0.5) * length) * along, length});
  }
  return nodes;
}

double euler_load(const RockBolt& bolt) {
  const double second_moment = bolt.area * bolt.area / (4 * std::numbers::pi),
               length = (bolt.to - bolt.from).norm();
  return std::numbers::pi * std::numbers::pi * bolt.young * second_moment / (length * length);
}

}  // namespace ddacontact
