#include <ddacontact/scene/selectors.hpp>

#include <ddacontact/scene/outline_distance.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace ddacontact::scene_format {

namespace {

bool has_outline(const BlockRecord& block) {
  return block.locations.good("vertices") && block.vertices.points.cols() >= 3;
}

Vec2 centroid(const BlockRecord& block) {
  return polyfem::area_moments(block.vertices.points).centroid;
}

double size_of(const BlockRecord& block) {
  return std::sqrt(std::abs(polyfem::area_moments(block.vertices.points).area));
}

std::string point_text(const Vec2& x) {
  return "(" + rounded(x.x()) + ", " + rounded(x.y()) + ")";
}

/// As results call it.
std::string name_of(const BlockRecord& block, int index) {
  return block.name && !block.name->empty() ? *block.name : std::to_string(index);
}

Points shape_of(const LineSegment& line) {
  Points ends(2, line.from == line.to ? 1 : 2);
  ends.col(0) = line.from;
  if (ends.cols() > 1) ends.col(1) = line.to;
  return ends;
}

/// A place as a point, a line or a polygon, by its number of columns.
Points shape_of(const Place& place) {
  if (place.at) return *place.at;
  if (place.inside) return *place.inside;
  const auto& [x0, y0, x1, y1] = *place.box;
  if (x0 == x1 || y0 == y1) return shape_of(LineSegment{{x0, y0}, {x1, y1}});
  Points corners(2, 4);
  corners << x0, x1, x1, x0, y0, y0, y1, y1;
  return corners;
}

Points shape_of(const PartSelector& selector) {
  return selector.on ? shape_of(*selector.on) : shape_of(static_cast<const Place&>(selector));
}

/// 0 in a polygon.
double distance_to(const Points& shape, const Vec2& x) {
  return shape.cols() == 1   ? (x - shape.col(0)).norm()
         : shape.cols() == 2 ? distance_to_edge(x, shape.col(0), shape.col(1))
                             : polyfem::distance_outside(shape, x);
}

std::string text_of(const PartSelector& selector) {
  if (selector.on)
    return "on the line from " + point_text(selector.on->from) + " to " + point_text(selector.on->to);
  if (selector.at) return "at " + point_text(*selector.at);
  return std::string(selector.box ? "in the box" : "in the polygon") + " around " +
         point_text(shape_of(selector).rowwise().mean());
}

std::vector<int> vertices_in(const Points& shape, const BlockRecord& block) {
  std::vector<int> found;
  const Points& points = block.vertices.points;
  for (int k = 0; k < points.cols(); ++k)
    if (distance_to(shape, points.col(k)) <= on_line * size_of(block)) found.push_back(k);
  return found;
}

/// Edges with both ends there; of a point those that it lies on.
std::vector<int> edges_in(const Points& shape, const BlockRecord& block) {
  const std::vector<int> vertices = vertices_in(shape, block);
  const Points& points = block.vertices.points;
  const int n = static_cast<int>(points.cols());
  std::vector<int> edges;
  for (int k = 0; k < n; ++k) {
    const int end = (k + 1) % n;
    if (shape.cols() == 1
            ? distance_to_edge(shape.col(0), points.col(k), points.col(end)) <= on_line * size_of(block)
            : std::ranges::count(vertices, k) > 0 && std::ranges::count(vertices, end) > 0)
      edges.push_back(k);
  }
  return edges;
}

bool catches(const BlockSelector& selector, const BlockRecord& block) {
  if (selector.group) return std::ranges::count(block.groups, *selector.group) > 0;
  if (!has_outline(block)) return false;
  if (selector.at) return polyfem::contains(block.vertices.points, *selector.at);
  return distance_to(shape_of(selector), centroid(block)) == 0;
}

void complain_of_group(const std::string& group, const Document& document, const SourceLocation& location,
                       ProblemList& problems) {
  std::set<std::string> groups;
  for (const BlockRecord& block : document.blocks) groups.insert(block.groups.begin(), block.groups.end());
  problems.error(
      location, "no block is in the group '" + excerpt(group) + "'",
      groups.empty() ? "no block has a 'group'" : suggestion(group, "group", {groups.begin(), groups.end()}));
}

void complain_of_location(const BlockSelector& selector, const Document& document,
                          const SourceLocation& location, ProblemList& problems) {
  const Vec2 x = shape_of(selector).rowwise().mean();
  int nearest_block = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < document.blocks.size(); ++b) {
    if (!has_outline(document.blocks[b])) continue;
    const double distance = (centroid(document.blocks[b]) - x).norm();
    if (!(distance < least)) continue;
    least = distance;
    nearest_block = static_cast<int>(b);
  }
  const std::string what = selector.at ? "no block is at " + point_text(x)
                                       : "no block has its centroid in the " +
                                             std::string(selector.box ? "box" : "polygon") + " around " +
                                             point_text(x);
  problems.error(location, what,
                 nearest_block < 0
                     ? "there is no block"
                     : "the nearest is block '" +
                           excerpt(name_of(document.blocks[nearest_block], nearest_block)) +
                           "' with its centroid at " + point_text(centroid(document.blocks[nearest_block])));
}

/// Nothing there: what of these blocks is nearest, a vertex, or of a point to be on an edge that edge.
void complain_of_part(const PartSelector& selector, const std::vector<int>& blocks, bool edges,
                      const Document& document, const SourceLocation& location, ProblemList& problems) {
  const Points shape = shape_of(selector);
  const bool to_edge = edges && shape.cols() == 1;
  std::string cure = "none of these blocks has vertices";
  double least = std::numeric_limits<double>::infinity();
  for (const int b : blocks) {
    const Points& points = document.blocks[b].vertices.points;
    for (int k = 0; k < points.cols(); ++k) {
      const double distance =
          to_edge ? distance_to_edge(shape.col(0), points.col(k), points.col((k + 1) % points.cols()))
                  : distance_to(shape, points.col(k));
      if (distance >= least) continue;
      least = distance;
      cure = std::string(to_edge ? "the nearest edge is " : "the nearest vertex is ") + std::to_string(k) +
             " of block '" + excerpt(name_of(document.blocks[b], b)) + "'" +
             (to_edge ? "" : " at " + point_text(points.col(k))) + ", " + rounded(distance) + " m away";
    }
  }
  if (edges && !to_edge) cure = "both ends of an edge have to lie there; " + cure;
  problems.error(location, std::string(edges ? "no edge lies " : "no vertex lies ") + text_of(selector),
                 cure);
}

class Expansion {
 public:
  Expansion(const Document& document, ProblemList& problems) : document_(document), problems_(problems) {}

  template <class Record, class Expand>
  std::vector<Record> of(const std::vector<Record>& records, const Expand& expand) {
    std::vector<Record> all;
    for (const Record& record : records) {
      const std::vector<int> blocks = blocks_of(record.block, record.locations);
      if (record.block.selector && blocks.empty()) {
        all.push_back(record);
        all.back().locations.spoil("block");
      } else if (!record.block.selector && !selects_parts(record)) {
        all.push_back(record);
      } else {
        expand(record, blocks, all);
      }
    }
    return all;
  }

  void support(const SupportRecord& record, const std::vector<int>& blocks, std::vector<SupportRecord>& all) {
    if (!selects_parts(record)) {
      for (const int b : blocks) all.push_back(with_block(record, b));
      return;
    }
    const Points shape = shape_of(*record.vertices.selector);
    const std::size_t before = all.size();
    for (const int b : blocks) {
      SupportRecord one = with_block(record, b);
      one.vertices.some = vertices_in(shape, document_.blocks[b]);
      if (!one.vertices.some.empty()) all.push_back(std::move(one));
    }
    if (blocks.empty() || all.size() > before) return;
    complain_of_part(*record.vertices.selector, blocks, false, document_, record.locations.of("vertices"),
                     problems_);
    all.push_back(with_block(record, blocks.front()));  // what is held is not known
  }

  void load(const LoadRecord& record, const std::vector<int>& blocks, std::vector<LoadRecord>& all) {
    if (!selects_parts(record)) {
      for (const int b : blocks) all.push_back(with_block(record, b));
      return;
    }
    const Points shape = shape_of(*record.edge->selector);
    const std::size_t before = all.size();
    for (const int b : blocks)
      for (const int edge : edges_in(shape, document_.blocks[b])) {
        all.push_back(with_block(record, b));
        all.back().edge = EdgeSelection{edge};
      }
    if (!blocks.empty() && all.size() == before)
      complain_of_part(*record.edge->selector, blocks, true, document_, record.locations.of("edge"),
                       problems_);
  }

  void quiet_boundary(QuietRecord& record) const {
    if (!record.locations.good("on")) return;
    const Points line = shape_of(record.on);
    std::vector<int> blocks;
    for (int b = 0; b < static_cast<int>(document_.blocks.size()); ++b) {
      if (!has_outline(document_.blocks[b])) continue;
      blocks.push_back(b);
      for (const int edge : edges_in(line, document_.blocks[b])) record.faces.push_back({b, edge});
    }
    if (record.faces.empty() && document_.has_all_blocks)
      complain_of_part({{}, record.on}, blocks, true, document_, record.locations.of("on"), problems_);
  }

  void monitor(const MonitorRecord& record, const std::vector<int>& blocks, std::vector<MonitorRecord>& all) {
    for (const int b : blocks) {
      all.push_back(with_block(record, b));
      if (blocks.size() > 1) all.back().name += '.' + name_of(document_.blocks[b], b);
    }
  }

  /// A block that a selector finds and that stands in the list already is in it once.
  void list(BlockList& blocks) {
    BlockList all;
    std::set<int> found;
    for (std::size_t i = 0; i < blocks.blocks.size(); ++i) {
      const BlockReference& one = blocks.blocks[i];
      const auto add = [&](BlockReference block) {
        all.blocks.push_back(std::move(block));
        all.locations.push_back(blocks.locations[i]);
      };
      if (!one.selector) {
        found.insert(find(one));
        add(one);
        continue;
      }
      for (const int b : find_blocks(*one.selector, document_, blocks.locations[i], problems_))
        if (found.insert(b).second) add(Reference{"", b});
    }
    blocks = std::move(all);
  }

 private:
  static bool selects_parts(const SupportRecord& record) {
    return record.vertices.selector && record.locations.good("vertices");
  }
  static bool selects_parts(const LoadRecord& record) {
    return record.edge && record.edge->selector && record.locations.good("edge");
  }
  static bool selects_parts(const MonitorRecord&) { return false; }

  template <class Record>
  static Record with_block(const Record& record, int block) {
    Record one = record;
    one.block = Reference{"", block};
    return one;
  }

  std::vector<int> blocks_of(const BlockReference& block, const KeyLocations& locations) {
    if (!locations.good("block")) return {};
    if (block.selector) return find_blocks(*block.selector, document_, locations.of("block"), problems_);
    const int index = find(block);
    return index < 0 ? std::vector<int>() : std::vector{index};
  }

  /// -1 when there is none, which is complained of where names are resolved.
  int find(const Reference& reference) const {
    const auto n = static_cast<std::int64_t>(document_.blocks.size());
    if (reference.index) return *reference.index < n ? static_cast<int>(*reference.index) : -1;
    for (std::int64_t b = 0; b < n; ++b)
      if (document_.blocks[b].name == reference.name) return static_cast<int>(b);
    return -1;
  }

  const Document& document_;
  ProblemList& problems_;
};

}  // namespace

std::vector<int> find_blocks(const BlockSelector& selector, const Document& document,
                             const SourceLocation& location, ProblemList& problems) {
  std::vector<int> found;
  for (std::size_t b = 0; b < document.blocks.size(); ++b)
    if (catches(selector, document.blocks[b])) found.push_back(static_cast<int>(b));
  if (!found.empty() || !document.has_all_blocks) return found;
  if (selector.group)
    complain_of_group(*selector.group, document, location, problems);
  else
    complain_of_location(selector, document, location, problems);
  return found;
}

void expand_selectors(Document& document, ProblemList& problems) {
  Expansion expansion(document, problems);
  document.supports = expansion.of(document.supports, [&](const auto& record, const auto& blocks, auto& all) {
    expansion.support(record, blocks, all);
  });
  document.loads = expansion.of(document.loads, [&](const auto& record, const auto& blocks, auto& all) {
    expansion.load(record, blocks, all);
  });
  document.monitors = expansion.of(document.monitors, [&](const auto& record, const auto& blocks, auto& all) {
    expansion.monitor(record, blocks, all);
  });
  for (QuietRecord& record : document.quiet_boundaries) expansion.quiet_boundary(record);
  for (StageRecord& stage : document.stages) {
    expansion.list(stage.remove);
    expansion.list(stage.add);
  }
}

}  // namespace ddacontact::scene_format
