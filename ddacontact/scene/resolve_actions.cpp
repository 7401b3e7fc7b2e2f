#include <ddacontact/scene/resolve_actions.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace ddacontact::scene_format {

namespace {

/// A point may lie outside its block by this times the block's size.
constexpr double outside_tolerance = 1e-9;

int find_block(const Reference& reference, const KeyLocations& locations, const BlockTable& blocks,
               ProblemList& problems) {
  return locations.good("block") ? blocks.names.find(reference, locations.of("block"), problems) : -1;
}

/// Complains when more than one of the keys is written well; says whether any is written.
bool at_most_one(std::initializer_list<const char*> keys, const KeyLocations& locations,
                 ProblemList& problems) {
  const char* first = nullptr;
  for (const char* key : keys) {
    if (!locations.written(key)) continue;
    if (!first)
      first = key;
    else if (locations.good(first) && locations.good(key))
      problems.error(locations.of(key), "both '" + std::string(first) + "' and '" + key + "' are given",
                     "leave one of them out");
  }
  return first != nullptr;
}

void check_inside(const Vec2& point, const char* kind, int block, const SourceLocation& location,
                  const BlockTable& blocks, ProblemList& problems) {
  if (block < 0 || !blocks.outlines[block].outline.valid()) return;
  const CheckedOutline& outline = blocks.outlines[block].outline;
  const double distance = outline.distance_outside(point);
  if (distance <= outside_tolerance * outline.size) return;
  problems.error(location,
                 std::string(kind) + " at (" + short_number(point.x()) + ", " + short_number(point.y()) +
                     ") lies " + rounded(distance) + " m outside " + blocks.names.title(block),
                 "move it into the block or onto its outline");
}

/// The number of vertices of a block whose vertices could be read, else 0.
int n_vertices(int block, const Document& document, const BlockTable& blocks) {
  return block >= 0 && document.blocks[block].locations.good("vertices") ? blocks.holds.n_vertices(block) : 0;
}

TimeFunction displacement_of(const SupportRecord& record) {
  TimeFunction function{TimeFunction::Kind::ramp, record.displacement.value_or(Vec2::Zero()), {}};
  if (record.velocity) {
    function.kind = TimeFunction::Kind::rate;
    function.value = *record.velocity;
  }
  using Kind = TimeFunction::Kind;
  const auto is_good = [&](const char* key) { return record.locations.good(key); };
  if (is_good("history")) {
    const bool of_file = !record.history->file.empty();
    const bool smooth = record.interpolation.value_or(
                            of_file ? Interpolation::smooth : Interpolation::linear) == Interpolation::smooth;
    function = history_function(smooth ? Kind::smooth_history : Kind::history, record.history->entries);
  } else if (is_good("velocity_history")) {
    function = history_function(Kind::velocity_history, record.velocity_history->entries);
  } else if (is_good("acceleration_history")) {
    function = history_function(Kind::acceleration_history, record.acceleration_history->entries);
  }
  return function;
}

bool moves(const Support& support, int axis) {
  for (const Vec3& entry : support.displacement.history)
    if (entry[1 + axis] != 0) return true;
  return support.displacement.value[axis] != 0;
}

/// Complains of a motion along an axis that the support leaves free: nothing would come of it.
void check_motion_of_free_axes(const Support& support, const KeyLocations& locations, ProblemList& problems) {
  const bool held[] = {support.fix_x, support.fix_y};
  for (int axis = 0; axis < 2; ++axis) {
    if (held[axis] || !moves(support, axis)) continue;
    for (const char* key :
         {"history", "velocity_history", "acceleration_history", "velocity", "displacement"}) {
      if (!locations.good(key)) continue;
      problems.error(
          locations.of(key),
          "'" + std::string(key) + "' moves vertices in " + "xy"[axis] + ", which 'axes' leaves free",
          "write 0 for " + std::string(1, "xy"[axis]) + ", or axes = \"xy\"");
      break;
    }
  }
}

/// Complains of entries of two numbers where a vector is meant, and the other way round.
void check_columns(const std::optional<History>& history, const char* key, int columns,
                   const KeyLocations& locations, ProblemList& problems) {
  if (!locations.good(key) || history->columns == columns) return;
  problems.error(
      locations.of(key),
      "entries of '" + std::string(key) + "' have " + std::to_string(history->columns) + " numbers",
      columns == 2 ? "a pressure has entries [t, value]" : "write [t, x, y]");
}

/// Less than seven entries a period of a sine.
constexpr double coarse_sampling = 0.1;

/// As records are; pulses of straight pieces are not.
bool is_sampled_evenly(const std::vector<Vec3>& entries) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t k = 1; k + 1 < entries.size(); ++k) {
    shortest = std::min(shortest, entries[k][0] - entries[k - 1][0]);
    longest = std::max(longest, entries[k][0] - entries[k - 1][0]);
  }
  return longest <= 10 * shortest;
}

void warn_of_sampling(const std::vector<Vec3>& entries, const char* key, const KeyLocations& locations,
                      ProblemList& problems) {
  if (is_sampled_evenly(entries) && sampling_error(entries) > coarse_sampling)
    problems.warning(locations.of(key),
                     "'" + std::string(key) + "' is sampled coarsely: lines between its entries are " +
                         rounded(100 * sampling_error(entries)) + " % away from a smooth curve through them",
                     "use a record with a shorter interval, or filter out what is faster");
}

/// Takes hold of one vertex along the axes of the support.
void hold(const Support& support, int index, int vertex, const SourceLocation& location, BlockTable& blocks,
          ProblemList& problems) {
  for (const int axis : {0, 1}) {
    if (!(axis == 0 ? support.fix_x : support.fix_y)) continue;
    int& by = blocks.holds.by(support.block, vertex, axis);
    const std::string where =
        "vertex '" + std::to_string(vertex) + "' of " + blocks.names.title(support.block);
    if (by >= 0)
      problems.error(location,
                     where + " is held in " + "xy"[axis] + " by support " + std::to_string(by) + " already",
                     "hold each direction of a vertex once");
    else if (by == Holds::fixed && moves(support, axis))
      problems.error(location, where + " is fixed and moved in " + "xy"[axis],
                     "take it out of 'fixed' or out of this support");
    if (by == Holds::nobody) by = index;
  }
}

struct LoadKeys {
  const char* name;
  const char* has;
  std::initializer_list<const char*> foreign;
};

const LoadKeys& keys_of(Load::Kind kind) {
  static const LoadKeys point{"point", "'block', 'at' and 'force' or 'history'", {"edge", "value"}};
  static const LoadKeys pressure{"pressure", "'block', 'edge' and 'value' or 'history'", {"at", "force"}};
  static const LoadKeys body{"body", "'block' and 'force' or 'history'", {"at", "edge", "value"}};
  return kind == Load::Kind::point ? point : kind == Load::Kind::pressure ? pressure : body;
}

void require(bool present, const char* key, const LoadRecord& record, ProblemList& problems) {
  if (present) return;
  const LoadKeys& keys = keys_of(record.type);
  problems.error(record.locations.table, "missing key '" + std::string(key) + "' in [[load]]",
                 "a load of type \"" + std::string(keys.name) + "\" has " + keys.has);
}

void check_load_keys(const LoadRecord& record, ProblemList& problems) {
  const LoadKeys& keys = keys_of(record.type);
  const KeyLocations& locations = record.locations;
  for (const char* key : keys.foreign)
    if (locations.written(key))
      problems.error(locations.of(key),
                     "'" + std::string(key) + "' does not belong to a load of type '" + keys.name + "'",
                     std::string("such a load has ") + keys.has);
  if (record.type == Load::Kind::pressure) {
    require(locations.written("edge"), "edge", record, problems);
    require(at_most_one({"value", "history"}, locations, problems), "value", record, problems);
  } else {
    if (record.type == Load::Kind::point) require(locations.written("at"), "at", record, problems);
    require(at_most_one({"force", "history"}, locations, problems), "force", record, problems);
  }
}

}  // namespace

std::vector<Support> resolve_supports(const Document& document, BlockTable& blocks, ProblemList& problems) {
  std::vector<Support> supports;
  for (const SupportRecord& record : document.supports) {
    const KeyLocations& locations = record.locations;
    Support support;
    support.block = find_block(record.block, locations, blocks, problems);
    support.fix_x = record.axes != Axes::y;
    support.fix_y = record.axes != Axes::x;
    at_most_one({"displacement", "velocity", "history", "velocity_history", "acceleration_history"},
                locations, problems);
    check_columns(record.history, "history", 3, locations, problems);
    check_columns(record.velocity_history, "velocity_history", 3, locations, problems);
    check_columns(record.acceleration_history, "acceleration_history", 3, locations, problems);
    support.displacement = displacement_of(record);
    check_motion_of_free_axes(support, locations, problems);
    for (const auto& [history, key] : {std::pair{&record.history, "history"},
                                       {&record.velocity_history, "velocity_history"},
                                       {&record.acceleration_history, "acceleration_history"}})
      if (locations.good(key) && support.displacement.kind != TimeFunction::Kind::history)
        warn_of_sampling((*history)->entries, key, locations, problems);
    if (locations.written("interpolation") && !locations.written("history"))
      problems.error(locations.of("interpolation"), "'interpolation' without 'history'", "leave it out");
    const int n = n_vertices(support.block, document, blocks);
    if (locations.good("vertices")) {
      if (record.vertices.some.empty() && !record.vertices.selector)
        problems.error(locations.of("vertices"), "'vertices' is empty", "name the vertices to be held");
      if (n > 0)
        support.vertices = check_vertex_indices(record.vertices.some, n, blocks.names.title(support.block),
                                                locations.of("vertices"), problems);
    }
    const int index = static_cast<int>(supports.size());
    for (const int vertex : locations.usable("axes") ? support.vertices : std::vector<int>())
      hold(support, index, vertex, locations.of("vertices"), blocks, problems);
    supports.push_back(std::move(support));
  }
  return supports;
}

std::vector<Load> resolve_loads(const Document& document, const BlockTable& blocks, ProblemList& problems) {
  std::vector<Load> loads;
  for (const LoadRecord& record : document.loads) {
    const KeyLocations& locations = record.locations;
    Load load;
    load.name = record.name.value_or("");
    load.kind = record.type;
    load.block = find_block(record.block, locations, blocks, problems);
    if (locations.good("type")) check_load_keys(record, problems);
    load.at = record.at.value_or(Vec2::Zero());
    if (locations.good("at"))
      check_inside(load.at, "point load", load.block, locations.of("at"), blocks, problems);
    load.edge = record.edge ? record.edge->edge : 0;
    const int n = n_vertices(load.block, document, blocks);
    if (locations.good("edge") && n > 0 && (load.edge < 0 || load.edge >= n))
      problems.error(locations.of("edge"),
                     blocks.names.title(load.block) + " has no edge '" + std::to_string(load.edge) + "'",
                     "edges run from 0 to " + std::to_string(n - 1));
    load.force.value = record.type == Load::Kind::pressure ? Vec2(record.value.value_or(0), 0)
                                                           : record.force.value_or(Vec2::Zero());
    check_columns(record.history, "history", record.type == Load::Kind::pressure ? 2 : 3, locations,
                  problems);
    if (locations.good("history")) {
      load.force = history_function(TimeFunction::Kind::history, record.history->entries);
      if (!record.history->file.empty())
        warn_of_sampling(record.history->entries, "history", locations, problems);
    }
    load.force.rise = record.ramp.value_or(0);
    loads.push_back(std::move(load));
  }
  return loads;
}

std::vector<QuietBoundary> resolve_quiet_boundaries(const Document& document, BlockTable& blocks,
                                                    ProblemList& problems) {
  std::vector<QuietBoundary> boundaries;
  for (const QuietRecord& record : document.quiet_boundaries) {
    QuietBoundary& boundary = boundaries.emplace_back();
    boundary.from = record.on.from;
    boundary.to = record.on.to;
    if (boundary.from == boundary.to && record.locations.good("on")) {
      problems.error(record.locations.of("on"), "the line 'on' has no length: its ends are one point",
                     "write two points of the boundary");
      continue;
    }
    boundary.faces = record.faces;
    check_columns(record.incoming, "incoming", 3, record.locations, problems);
    if (record.locations.good("incoming")) {
      boundary.incoming = history_function(TimeFunction::Kind::history, record.incoming->entries);
      warn_of_sampling(record.incoming->entries, "incoming", record.locations, problems);
    }
    for (const QuietBoundary::Face& face : boundary.faces) {
      const int n = n_vertices(face.block, document, blocks);
      if (n == 0) continue;
      for (int axis = 0; axis < 2; ++axis)
        if (blocks.holds.by(face.block, face.edge, axis) != Holds::nobody &&
            blocks.holds.by(face.block, (face.edge + 1) % n, axis) != Holds::nobody) {
          problems.error(record.locations.table,
                         "edge '" + std::to_string(face.edge) + "' of " + blocks.names.title(face.block) +
                             " is quiet and held in " + "xy"[axis],
                         "a held edge absorbs no waves: take it out of the support, 'fixed' or this line");
          break;
        }
    }
  }
  return boundaries;
}

std::vector<Quake> resolve_quakes(const Document& document, ProblemList& problems) {
  std::vector<Quake> quakes;
  for (const QuakeRecord& record : document.quakes) {
    check_columns(record.acceleration, "acceleration", 3, record.locations, problems);
    if (!record.locations.good("acceleration")) continue;
    std::vector<Vec3> entries = record.acceleration.entries;
    for (Vec3& entry : entries) entry.tail<2>() *= record.scale;
    warn_of_sampling(entries, "acceleration", record.locations, problems);
    quakes.push_back({history_function(TimeFunction::Kind::history, std::move(entries))});
  }
  return quakes;
}

std::vector<Monitor> resolve_monitors(const Document& document, const BlockTable& blocks,
                                      ProblemList& problems) {
  NameTable names("monitor");
  std::vector<Monitor> monitors;
  for (const MonitorRecord& record : document.monitors) {
    const KeyLocations& locations = record.locations;
    names.add(record.name, locations, problems);
    Monitor monitor;
    monitor.name = record.name;
    monitor.block = find_block(record.block, locations, blocks, problems);
    if (!at_most_one({"at", "vertex"}, locations, problems))
      problems.error(locations.table, "missing key 'at' in [[monitor]]",
                     "add 'at' = [x, y] or \"centroid\", or 'vertex' = k");
    if (record.at && record.at->point) {
      monitor.kind = Monitor::Kind::point;
      monitor.at = *record.at->point;
      if (locations.good("at"))
        check_inside(monitor.at, "monitor", monitor.block, locations.of("at"), blocks, problems);
    } else if (record.vertex) {
      monitor.kind = Monitor::Kind::vertex;
      monitor.vertex = *record.vertex;
      const int n = n_vertices(monitor.block, document, blocks);
      if (locations.good("vertex") && n > 0 && (monitor.vertex < 0 || monitor.vertex >= n))
        problems.error(
            locations.of("vertex"),
            blocks.names.title(monitor.block) + " has no vertex '" + std::to_string(monitor.vertex) + "'",
            "vertices run from 0 to " + std::to_string(n - 1));
    }
    monitors.push_back(std::move(monitor));
  }
  return monitors;
}

}  // namespace ddacontact::scene_format
