#include <ddacontact/scene/free_sides.hpp>

#include <ddacontact/scene/domain_blocks.hpp>
#include <ddacontact/scene/selectors.hpp>
#include <ddacontact/scene/static_check.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace ddacontact::scene_format {

namespace {

/// A line along an axis through the box of the domain.
struct Side {
  const char* name;
  int across;  ///< 0: it is vertical, 1: horizontal
  double at;
};

/// A part of a side along which edges are not held.
struct FreePart {
  double from, to;
};

class DomainSides {
 public:
  DomainSides(const Document& document, const Scene& scene, const BlockTable& blocks)
      : scene_(scene), blocks_(blocks) {
    for (std::size_t b = 0; b < document.blocks.size(); ++b)
      (document.blocks[b].origin == domain_origin ? inside_ : others_).push_back(static_cast<int>(b));
    for (const Load& load : scene.loads)
      if (load.kind == Load::Kind::pressure) loaded_.insert({load.block, load.edge});
    for (const QuietBoundary& boundary : scene.quiet_boundaries)
      for (const auto& [block, edge] : boundary.faces) loaded_.insert({block, edge});
  }

  bool holds_any() const {
    return std::ranges::any_of(inside_, [&](int b) { return blocks_.holds.holds_any(b); });
  }

  /// In ascending order, as long as they go on without a held edge between them.
  std::vector<FreePart> free_parts(const Side& side) const {
    std::vector<FreePart> edges = free_edges(side), parts;
    std::ranges::sort(edges, {}, &FreePart::from);
    for (const FreePart& edge : edges) {
      const bool goes_on =
          !parts.empty() && edge.from - parts.back().to <= on_line * (edges.back().to - edges.front().from);
      if (goes_on)
        parts.back().to = std::max(parts.back().to, edge.to);
      else
        parts.push_back(edge);
    }
    return parts;
  }

 private:
  std::vector<FreePart> free_edges(const Side& side) const {
    std::vector<FreePart> edges;
    for (const int b : inside_) {
      const Points& outline = scene_.blocks[b].vertices;
      const double tolerance = on_line * blocks_.outlines[b].outline.size;
      const auto is_on_side = [&](Index k) {
        return std::abs(outline(side.across, k) - side.at) <= tolerance;
      };
      for (Index k = 0; k < outline.cols(); ++k) {
        const Index next = (k + 1) % outline.cols();
        if (!is_on_side(k) || !is_on_side(next) || is_held(b, static_cast<int>(k), static_cast<int>(next)))
          continue;
        const auto [low, high] = std::minmax(outline(1 - side.across, k), outline(1 - side.across, next));
        edges.push_back({low, high});
      }
    }
    return edges;
  }

  bool is_held(int b, int edge, int next) const {
    if (blocks_.holds.holds_vertex(b, edge) || blocks_.holds.holds_vertex(b, next)) return true;
    if (loaded_.contains({b, edge})) return true;
    const Vec2 middle = (scene_.blocks[b].vertices.col(edge) + scene_.blocks[b].vertices.col(next)) / 2;
    return std::ranges::any_of(others_, [&](int other) {
      const CheckedOutline& outline = blocks_.outlines[other].outline;
      return outline.distance_outside(middle) <= nearly_touching * outline.size;
    });
  }

  const Scene& scene_;
  const BlockTable& blocks_;
  std::vector<int> inside_, others_;      ///< blocks of the domain, and those stated otherwise
  std::set<std::pair<int, int>> loaded_;  ///< block and edge
};

/// Free on all sides, as in a press.
bool is_specimen(const DomainRecord& domain, const Vec2& size) {
  return domain.openings.empty() &&
         std::abs(polyfem::signed_area(domain.boundary.outline.points)) >= (1 - on_line) * size.prod();
}

std::string point_text(const Side& side, double along) {
  const std::string at = rounded(side.at), there = rounded(along);
  return side.across == 0 ? "[" + at + ", " + there + "]" : "[" + there + ", " + at + "]";
}

}  // namespace

void warn_of_free_sides(const Document& document, const Scene& scene, const BlockTable& blocks,
                        ProblemList& problems) {
  if (!document.domain) return;
  const Points& outline = document.domain->boundary.outline.points;
  const Vec2 low = outline.rowwise().minCoeff(), high = outline.rowwise().maxCoeff();
  const DomainSides sides(document, scene, blocks);
  if (is_specimen(*document.domain, high - low) || !sides.holds_any()) return;
  for (const Side& side :
       {Side{"left", 0, low.x()}, Side{"right", 0, high.x()}, Side{"bottom", 1, low.y()}}) {
    for (const FreePart& part : sides.free_parts(side)) {
      const std::string from = point_text(side, part.from), to = point_text(side, part.to);
      problems.warning(document.domain->locations.of("boundary"),
                       "the " + std::string(side.name) + " side of the domain is not held between " + from +
                           " and " + to + ": blocks slide out of it if the rock goes on there",
                       "hold it: [[support]] of a selector as 'block' with 'vertices' = { on = [" + from +
                           ", " + to + "] }, or a [[domain.region]] along it with 'fixed' and 'cut'");
    }
  }
}

}  // namespace ddacontact::scene_format
