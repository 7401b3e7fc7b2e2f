#include <ddacontact/domain/domain_cutting.hpp>

#include <ddacontact/domain/joint_traces.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace ddacontact {

namespace {

using polyfem::Error;
using polyfem::Segment;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

Points counter_clockwise(const Points& polygon) {
  return polyfem::signed_area(polygon) < 0 ? Points(polygon.rowwise().reverse()) : polygon;
}

const Points& place_of(const Domain& domain, int region) {
  return region < 0 ? domain.boundary : domain.regions[region].polygon;
}

double area_of(const Domain& domain, int region) {
  return std::abs(polyfem::signed_area(place_of(domain, region)));
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Length of traces per area.
double intensity(const JointSet& set) {
  return set.trace / (set.trace + set.gap) / set.spacing;
}

/// What the lines of one mark are.
struct Cut {
  int joint;
  bool may_go;  ///< slivers are merged across it
};

/// All lines that cut the domain, those that count first where they overlap before others.
class CuttingLines {
 public:
  /// \param[in] lengthened  both ends of a trace, by this part of its first and last line
  CuttingLines(const Domain& domain, double snap, double lengthened = 0)
      : domain_(domain), snap_(snap), lengthened_(lengthened) {
    for (const DomainOpening& opening : domain.openings) add_ring(opening.outline, {opening.joint, false});
    for (const DomainRegion& region : domain.regions)
      if (region.cut) add_ring(region.polygon, {region.joint, false});
    for (const JointTrace& trace : domain.traces) add_trace(trace);
    for (std::size_t s = 0; s < domain.joint_sets.size(); ++s) add_set(domain.joint_sets[s], s);
    for (const VoronoiCells& cells : domain.voronoi) add_cells(cells);
  }

  const std::vector<Segment>& segments() const { return segments_; }
  int joint(int mark) const { return mark < 0 ? -1 : cuts_[mark].joint; }
  bool may_go(int mark) const { return mark >= 0 && cuts_[mark].may_go; }

 private:
  int next_mark(const Cut& cut) {
    cuts_.push_back(cut);
    return static_cast<int>(cuts_.size()) - 1;
  }
  void add_ring(const Points& ring, const Cut& cut) {
    const int mark = next_mark(cut);
    for (Index k = 0; k < ring.cols(); ++k)
      segments_.push_back({ring.col(k), ring.col((k + 1) % ring.cols()), mark});
  }
  /// Lengthened at both ends: drawings often end a little before the line that they mean.
  void add_trace(const JointTrace& trace) {
    const int mark = next_mark({trace.joint, true});
    const Index last = trace.points.cols() - 1;
    const bool is_open = trace.points.col(0) != trace.points.col(last);
    for (Index k = 0; k < last; ++k) {
      Vec2 from = trace.points.col(k), to = trace.points.col(k + 1);
      const Vec2 more = lengthened_ * (to - from) + 2 * snap_ * (to - from).normalized();
      if (is_open && k == 0) from -= more;
      if (is_open && k + 1 == last) to += more;
      segments_.push_back({from, to, mark});
    }
  }
  void add_set(const JointSet& set, std::size_t index) {
    const int mark = next_mark({set.joint, true});
    const Points& place = place_of(domain_, set.region);
    // Neighbouring seeds share no set: they are the samples of a Monte Carlo study.
    const std::uint64_t seed = domain_.seed * 0x9E3779B97F4A7C15u + index;
    for (const Segment& trace : joint_traces(set, place, seed, mark)) {
      if (set.region < 0)
        segments_.push_back(trace);
      else
        for (const Segment& part : parts_inside(trace, place)) segments_.push_back(part);
    }
  }
  void add_cells(const VoronoiCells& cells) {
    const int mark = next_mark({cells.joint, true});
    const polyfem::PolygonMesh mesh =
        polyfem::voronoi(place_of(domain_, cells.region), {.n_cells = cells.cells, .seed = domain_.seed});
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const auto corners = mesh.cell(c);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const int from = corners[k], to = corners[(k + 1) % corners.size()];
        segments_.push_back({mesh.vertices.col(from), mesh.vertices.col(to), mark});
      }
    }
  }

  const Domain& domain_;
  double snap_, lengthened_;
  std::vector<Segment> segments_;
  std::vector<Cut> cuts_;
};

/// A point in a simple polygon, far from its outline.
Vec2 inner_point(const Points& polygon) {
  const Vec2 centroid = polyfem::area_moments(polygon).centroid;
  if (polyfem::contains(polygon, centroid)) return centroid;
  double largest = 0;
  Vec2 point = centroid;
  const polyfem::Triangles triangles = polyfem::triangulate(polygon);
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Vec2 a = polygon.col(triangles(0, t)), b = polygon.col(triangles(1, t)),
               c = polygon.col(triangles(2, t));
    const double area = polyfem::cross(b - a, c - a);
    if (area <= largest) continue;
    largest = area;
    point = (a + b + c) / 3;
  }
  return point;
}

CutBlock block_of(const polyfem::CutCells& cells, const polyfem::CutCell& cell, const CuttingLines& lines,
                  const Domain& domain) {
  const Points outline = cells.outline(cell);
  const Index n = outline.cols();
  Index first = 0;
  for (Index k = 1; k < n; ++k)
    if (std::pair(outline(1, k), outline(0, k)) < std::pair(outline(1, first), outline(0, first))) first = k;
  CutBlock block;
  block.outline.resize(2, n);
  for (Index k = 0; k < n; ++k) {
    block.outline.col(k) = outline.col((first + k) % n);
    block.joints.push_back(lines.joint(cell.marks[(first + k) % n]));
  }
  if (domain.regions.empty() && domain.openings.empty()) return block;
  const Vec2 inside = inner_point(block.outline);
  for (std::size_t r = 0; r < domain.regions.size(); ++r)
    if (polyfem::contains(domain.regions[r].polygon, inside)) block.regions.push_back(static_cast<int>(r));
  // Around an opening whose lines are lost, smaller than the snap, lies a block of any size.
  const double half_area = polyfem::signed_area(block.outline) / 2;
  for (std::size_t o = 0; o < domain.openings.size(); ++o)
    if (polyfem::contains(domain.openings[o].outline, inside) &&
        half_area <= std::abs(polyfem::signed_area(domain.openings[o].outline)))
      block.openings.push_back(static_cast<int>(o));
  return block;
}

/// By pairs: added one after the other, blocks of one size would all be rounded to the same side.
double total_area(std::span<const CutBlock> blocks) {
  if (blocks.empty()) return 0;
  if (blocks.size() == 1) return polyfem::signed_area(blocks.front().outline);
  const std::size_t half = blocks.size() / 2;
  return total_area(blocks.first(half)) + total_area(blocks.subspan(half));
}

void sort_by_rows(std::vector<CutBlock>& blocks, double height) {
  struct Key {
    double row, x, y;
    std::size_t index;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Vec2 centroid = polyfem::area_moments(blocks[b].outline).centroid;
    keys.push_back({std::floor(centroid.y() / height), centroid.x(), centroid.y(), b});
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) { return a < b; });
  std::vector<CutBlock> sorted;
  for (const Key& key : keys) sorted.push_back(std::move(blocks[key.index]));
  blocks = std::move(sorted);
}

void require_simple(const Points& polygon, const std::string& title) {
  if (polyfem::find_defect(polygon))
    throw Error(title + " is not a simple polygon (its edges must not cross)");
}

void require_valid(const Domain& domain) {
  require_simple(domain.boundary, "the boundary of the domain");
  for (const DomainRegion& region : domain.regions) require_simple(region.polygon, "a region of the domain");
  for (const DomainOpening& opening : domain.openings)
    require_simple(opening.outline, "an opening of the domain");
  const ExpectedCut expected = expected_cut(domain);
  const double most = std::max(expected.blocks, expected.traces);
  if (!(most <= most_blocks))
    throw TooManyBlocks("the domain would be cut into about " + number(most) + " blocks or traces (at most " +
                        number(most_blocks) +
                        ": wider spacings, longer traces or a smaller domain make fewer)");
}

}  // namespace

ExpectedCut expected_cut(const Domain& domain) {
  ExpectedCut cut;
  double most_traces = 0;
  for (std::size_t i = 0; i < domain.joint_sets.size(); ++i) {
    const JointSet& set = domain.joint_sets[i];
    const double area = area_of(domain, set.region), across = intensity(set), extent = std::sqrt(area),
                 n_traces = n_joint_traces(set, place_of(domain, set.region));
    cut.blocks += across * extent;
    double crossings = 0, ends = 1 / extent;  // of its blocks; per length of its traces
    for (std::size_t j = 0; j < domain.joint_sets.size(); ++j) {
      if (i == j) continue;
      const JointSet& other = domain.joint_sets[j];
      const double met = intensity(other) * std::abs(std::sin(radians(set.angle - other.angle))),
                   common = across * met * std::min(area, area_of(domain, other.region));
      if (j < i) cut.blocks += common;
      crossings += common;
      ends += met;
    }
    const double own_blocks = across * extent + crossings;
    cut.box_pairs +=
        own_blocks * std::min(own_blocks / 2, across / ends * std::abs(std::sin(radians(2 * set.angle))));
    cut.traces += n_traces;
    if (!(n_traces > most_traces)) continue;
    most_traces = n_traces;
    cut.densest_set = static_cast<int>(i);
  }
  for (const VoronoiCells& cells : domain.voronoi) cut.blocks += cells.cells;
  return cut;
}

namespace {

/// Ends of drawn lines that stop short of the line that they mean divide nothing, without a trace in what is
/// cut: how many blocks more there were if they went on a little.
int n_cut_by_longer(const Domain& domain, const Points& boundary, double snap, std::size_t n_cells) {
  constexpr double lengthened = 0.05;
  const CuttingLines lines(domain, snap, lengthened);
  const std::size_t n = polyfem::cut_cells(boundary, lines.segments(), snap).cells.size();
  return n > n_cells ? static_cast<int>(n - n_cells) : 0;
}

}  // namespace

CutDomain cut_domain(const Domain& domain) {
  require_valid(domain);
  const Points boundary = counter_clockwise(domain.boundary);
  const double area = polyfem::signed_area(boundary),
               snap = domain.snap > 0 ? domain.snap : 1e-6 * std::sqrt(area / expected_cut(domain).blocks);
  const CuttingLines lines(domain, snap);
  polyfem::CutCells cells = polyfem::cut_cells(boundary, lines.segments(), snap);
  CutDomain result;
  DomainCounts& counts = result.counts;
  if (!domain.traces.empty() && cells.n_dangling > 0)
    counts.cut_by_longer = n_cut_by_longer(domain, boundary, snap, cells.cells.size());
  if (domain.sliver_policy == SliverPolicy::merge)
    counts.slivers_merged =
        polyfem::merge_slivers(cells, domain.sliver, [&](int mark) { return lines.may_go(mark); });
  counts.slivers_left = static_cast<int>(polyfem::find_slivers(cells, domain.sliver).size());
  if (domain.sliver_policy == SliverPolicy::refuse && counts.slivers_left > 0)
    throw Error("the joints cut " + std::to_string(counts.slivers_left) +
                " slivers (policy = \"merge\" takes them into their neighbours)");
  counts.dangling_removed = cells.n_dangling;
  counts.connecting_joints = cells.n_connecting;
  counts.t_vertices = polyfem::drop_straight_corners(cells, domain.keep_t_vertices);
  for (const polyfem::CutCell& cell : cells.cells)
    result.blocks.push_back(block_of(cells, cell, lines, domain));
  counts.blocks = static_cast<int>(result.blocks.size());
  sort_by_rows(result.blocks, std::sqrt(area / counts.blocks));
  counts.area = total_area(result.blocks);
  return result;
}

}  // namespace ddacontact
