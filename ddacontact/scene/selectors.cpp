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

double distance_to(const LineSegment& line, const Vec2& x) {
  return distance_to_edge(x, line.from, line.to);
}

std::vector<int> vertices_on(const LineSegment& line, const BlockRecord& block) {
  std::vector<int> found;
  const Points& points = block.vertices.points;
  for (int k = 0; k < points.cols(); ++k)
    if (distance_to(line, points.col(k)) <= on_line * size_of(block)) found.push_back(k);
  return found;
}

std::vector<int> edges_on(const LineSegment& line, const BlockRecord& block) {
  const std::vector<int> vertices = vertices_on(line, block);
  const int n = static_cast<int>(block.vertices.points.cols());
  std::vector<int> edges;
  for (const int k : vertices)
    if (std::ranges::count(vertices, (k + 1) % n) > 0) edges.push_back(k);
  return edges;
}

bool catches(const BlockSelector& selector, const BlockRecord& block) {
  if (selector.group) return std::ranges::count(block.groups, *selector.group) > 0;
  if (!has_outline(block)) return false;
  if (selector.at) return polyfem::contains(block.vertices.points, *selector.at);
  const Vec2 x = centroid(block);
  if (selector.inside) return polyfem::contains(*selector.inside, x);
  const auto& [x0, y0, x1, y1] = *selector.box;
  return x.x() >= std::min(x0, x1) && x.x() <= std::max(x0, x1) && x.y() >= std::min(y0, y1) &&
         x.y() <= std::max(y0, y1);
}

/// What the place of a selector is measured from to say what is near.
Vec2 middle(const BlockSelector& selector) {
  if (selector.at) return *selector.at;
  if (selector.inside) return selector.inside->rowwise().mean();
  const auto& [x0, y0, x1, y1] = *selector.box;
  return {(x0 + x1) / 2, (y0 + y1) / 2};
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
  const Vec2 x = middle(selector);
  int nearest_block = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < document.blocks.size(); ++b) {
    if (!has_outline(document.blocks[b])) continue;
    const double distance = (centroid(document.blocks[b]) - x).norm();
    if (distance >= least) continue;
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

/// Nothing on a line: which vertex of these blocks is nearest to it.
void complain_of_line(const LineSegment& line, const std::vector<int>& blocks, const char* what,
                      const Document& document, const SourceLocation& location, ProblemList& problems) {
  std::string cure = "none of these blocks has vertices";
  double least = std::numeric_limits<double>::infinity();
  for (const int b : blocks) {
    const Points& points = document.blocks[b].vertices.points;
    for (int k = 0; k < points.cols(); ++k) {
      const double distance = distance_to(line, points.col(k));
      if (distance >= least) continue;
      least = distance;
      cure = "the nearest vertex is " + std::to_string(k) + " of block '" +
             excerpt(name_of(document.blocks[b], b)) + "' at " + point_text(points.col(k)) + ", " +
             rounded(distance) + " m away";
    }
  }
  problems.error(location,
                 std::string("no ") + what + " lies on the line from " + point_text(line.from) + " to " +
                     point_text(line.to),
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
      if (!record.block.selector && !has_line(record))
        all.push_back(record);
      else
        expand(record, blocks, all);
    }
    return all;
  }

  void support(const SupportRecord& record, const std::vector<int>& blocks, std::vector<SupportRecord>& all) {
    const std::size_t before = all.size();
    for (const int b : blocks) {
      SupportRecord one = with_block(record, b);
      if (record.vertices.on) one.vertices.some = vertices_on(*record.vertices.on, document_.blocks[b]);
      if (!record.vertices.on || !one.vertices.some.empty()) all.push_back(std::move(one));
    }
    if (record.vertices.on && !blocks.empty() && all.size() == before)
      complain_of_line(*record.vertices.on, blocks, "vertex", document_, record.locations.of("vertices"),
                       problems_);
  }

  void load(const LoadRecord& record, const std::vector<int>& blocks, std::vector<LoadRecord>& all) {
    const bool on = has_line(record);
    const std::size_t before = all.size();
    for (const int b : blocks) {
      if (!on) all.push_back(with_block(record, b));
      if (!on) continue;
      for (const int edge : edges_on(*record.edge->on, document_.blocks[b])) {
        all.push_back(with_block(record, b));
        all.back().edge = EdgeSelection{edge};
      }
    }
    if (on && !blocks.empty() && all.size() == before)
      complain_of_line(*record.edge->on, blocks, "edge", document_, record.locations.of("edge"), problems_);
  }

  void quiet_boundary(QuietRecord& record) const {
    if (!record.locations.good("on")) return;
    std::vector<int> blocks;
    for (int b = 0; b < static_cast<int>(document_.blocks.size()); ++b) {
      if (!has_outline(document_.blocks[b])) continue;
      blocks.push_back(b);
      for (const int edge : edges_on(record.on, document_.blocks[b])) record.faces.push_back({b, edge});
    }
    if (record.faces.empty() && document_.has_all_blocks)
      complain_of_line(record.on, blocks, "edge", document_, record.locations.of("on"), problems_);
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
  static bool has_line(const SupportRecord& record) { return record.vertices.on.has_value(); }
  static bool has_line(const LoadRecord& record) { return record.edge && record.edge->on; }
  static bool has_line(const MonitorRecord&) { return false; }

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
