#include <ddacontact/scene/available_memory.hpp>
#include <ddacontact/scene/domain_blocks.hpp>

#include <ddacontact/domain/domain_cutting.hpp>
#include <ddacontact/domain/opening_shapes.hpp>
#include <ddacontact/scene/drawing_file.hpp>
#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/scene/memory_estimate.hpp>
#include <ddacontact/scene/names.hpp>
#include <ddacontact/scene/outline_check.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace ddacontact::scene_format {

namespace {

/// From the records of a domain to what is cut, and back to records of blocks.
class DomainReader {
 public:
  DomainReader(const Document& document, ProblemList& problems)
      : record_(*document.domain), problems_(problems) {
    ProblemList told_later("");
    for (const JointRecord& joint : document.joints) {
      joint_references_.push_back(joint.name ? Reference{*joint.name, {}} : Reference{"", joints_.size()});
      joints_.add(joint.name, joint.locations, told_later);
    }
    for (const RegionRecord& region : record_.regions) regions_.add(region.name, region.locations, problems);
    check_outlines();
    domain_.boundary = record_.boundary.outline.points;
    domain_.seed = static_cast<std::uint64_t>(record_.seed);
    domain_.keep_t_vertices = record_.t_vertices == TVertices::keep;
    domain_.snap = record_.snap.value_or(0);
    if (record_.sliver) {
      domain_.sliver = record_.sliver->limits;
      domain_.sliver_policy = record_.sliver->policy;
    }
    for (const RegionRecord& region : record_.regions)
      domain_.regions.push_back({region.polygon.points, region.cut, joint_of(region)});
    add_openings();
    for (const TraceRecord& trace : record_.traces) add_trace(trace);
    for (const JointSetRecord& set : record_.joint_sets) {
      JointSet& added = domain_.joint_sets.emplace_back(set.set);
      added.joint = joint_of(set);
      added.region = region_of(set);
      check_spacing(set);
      check_gap(set);
    }
    for (const VoronoiRecord& cells : record_.voronoi)
      domain_.voronoi.push_back({joint_of(cells), region_of(cells), cells.cells});
  }

  const Domain& domain() const { return domain_; }

  /// Nothing for a block of an excavated opening.
  std::optional<BlockRecord> block(const CutBlock& cut, std::size_t number) const {
    BlockRecord block;
    block.name = "d" + std::to_string(number);
    block.origin = domain_origin;
    block.locations.table = record_.locations.table;
    block.vertices.points = cut.outline;
    for (const char* key : {"name", "vertices"})
      block.locations.add(key, record_.locations.of("boundary"), true);
    std::optional<Reference> material = record_.material;
    for (const int r : cut.regions) {
      const RegionRecord& region = record_.regions[r];
      if (region.material) material = region.material;
      if (region.model) block.model = region.model;
      if (region.group) add_group(*region.group, block);
      if (region.fixed) block.fixed.all = *region.fixed;
    }
    for (const int o : cut.openings) {
      if (record_.openings[o].excavated) return std::nullopt;
      add_group(record_.openings[o].name, block);
    }
    if (material) {
      block.material = *material;
      block.locations.add("material", record_.locations.of("material"), true);
    }
    block.edge_joints = edge_joints(cut.joints);
    return block;
  }

 private:
  void check_outlines() {
    if (record_.locations.good("boundary"))
      check_simple(record_.boundary.outline, record_.locations.of("boundary"), "the boundary of the domain",
                   problems_);
    for (const RegionRecord& region : record_.regions)
      if (region.locations.good("polygon"))
        check_simple(region.polygon, region.locations.of("polygon"),
                     "the region '" + excerpt(region.name) + "'", problems_);
    for (const OpeningRecord& opening : record_.openings)
      if (opening.locations.good("polygon"))
        check_simple(*opening.polygon, opening.locations.of("polygon"),
                     "the opening '" + excerpt(opening.name) + "'", problems_);
  }

  /// Lines are counted from the origin of their set: their spacing must count beside their numbers.
  void check_spacing(const JointSetRecord& record) {
    constexpr double told_apart = 1e-12;
    const Points& boundary = domain_.boundary;
    if (boundary.cols() == 0 || !record_.locations.good("boundary") || !record.locations.usable("spacing") ||
        !record.locations.usable("origin"))
      return;
    const double distance = (boundary.colwise() - record.set.origin).colwise().norm().maxCoeff(),
                 size = (boundary.rowwise().maxCoeff() - boundary.rowwise().minCoeff()).norm();
    if (told_apart * size > record.set.spacing)
      problems_.error(record.locations.of("spacing"),
                      "'spacing' = '" + short_number(record.set.spacing) + "' is too small for a domain of " +
                          rounded(size) + " m: where its joints are is lost in round-off",
                      "write a wider spacing");
    else if (told_apart * distance > record.set.spacing)
      problems_.error(record.locations.of("origin"),
                      "this 'origin' is " + rounded(distance) +
                          " m from the domain: where its joints are is lost in round-off",
                      "give a point in the domain or near it");
  }

  /// Traces without an end have no bridges between them.
  void check_gap(const JointSetRecord& record) {
    for (const char* key : {"gap", "gap_deviation"})
      if (record.locations.good(key) && !record.locations.written("trace") &&
          record.set.gap + record.set.gap_deviation > 0)
        problems_.error(record.locations.of(key),
                        "'" + std::string(key) + "' without 'trace': the lines run through",
                        "write the length of a 'trace', or leave it out");
  }

  template <class Record>
  int joint_of(const Record& record) {
    const bool is_known = record.joint && record.locations.usable("joint");
    return is_known ? joints_.find(*record.joint, record.locations.of("joint"), problems_) : -1;
  }
  template <class Record>
  int region_of(const Record& record) {
    if (!record.inside || !record.locations.usable("inside")) return -1;
    return regions_.find({*record.inside, std::nullopt}, record.locations.of("inside"), problems_);
  }

  void add_trace(const TraceRecord& trace) {
    const Points& points = trace.points.points;
    if (!trace.locations.usable("points")) return;
    for (Index k = 0; k + 1 < points.cols(); ++k)
      if (points.col(k) == points.col(k + 1))
        problems_.error(trace.points.locations[k + 1], "the trace has the same point twice", "leave one out");
    if (points.cols() < 2)
      problems_.error(trace.locations.of("points"), "a trace of fewer than two points is no line",
                      "add points");
    domain_.traces.push_back({joint_of(trace), points});
  }

  void add_openings() {
    NameTable names("opening");
    for (const OpeningRecord& opening : record_.openings) {
      names.add(opening.name, opening.locations, problems_);
      domain_.openings.push_back({outline_of(opening), joint_of(opening)});
    }
  }

  Points outline_of(const OpeningRecord& opening) {
    const auto is_given = [&](const char* key) { return opening.locations.written(key); };
    const int n_given = is_given("circle") + is_given("horseshoe") + is_given("polygon");
    if (n_given != 1)
      problems_.error(opening.locations.table,
                      "the opening has " + std::string(n_given == 0 ? "no outline" : "more than one outline"),
                      "write 'circle', 'horseshoe' or 'polygon'");
    if (const auto& circle = opening.circle; opening.locations.good("circle"))
      return circle_outline(circle->centre, circle->radius, circle->edges);
    if (const auto& shoe = opening.horseshoe; opening.locations.good("horseshoe")) {
      if (shoe->height < shoe->width / 2)
        problems_.error(shoe->locations.of("height"),
                        "the horseshoe is lower than the half circle of its roof",
                        "write a 'height' of half the 'width' at least");
      return horseshoe_outline(shoe->floor, shoe->width, shoe->height, shoe->edges);
    }
    return opening.polygon ? opening.polygon->points : Points();
  }

  static void add_group(const std::string& name, BlockRecord& block) {
    if (std::ranges::find(block.groups, name) == block.groups.end()) block.groups.push_back(name);
  }

  /// Nothing where the materials decide of all edges.
  std::optional<EdgeJoints> edge_joints(const std::vector<int>& joints) const {
    if (std::ranges::all_of(joints, [](int joint) { return joint < 0; })) return std::nullopt;
    EdgeJoints names;
    for (const int joint : joints) {
      names.joints.push_back(joint < 0 ? Reference() : joint_references_[joint]);
    }
    return names;
  }

  const DomainRecord& record_;
  ProblemList& problems_;
  NameTable joints_{"joint"}, regions_{"region"};
  std::vector<Reference> joint_references_;
  Domain domain_;
};

/// Where the number of blocks is stated: at the spacing of the set with the most traces.
const SourceLocation& place_of_size(const ExpectedCut& expected, const DomainRecord& record) {
  const int densest = expected.densest_set;
  return densest < 0 ? record.locations.of("boundary") : record.joint_sets[densest].locations.of("spacing");
}

/// Whether the blocks fit into memory, told before they are cut.
bool fits_into_memory(const ExpectedCut& expected, const SourceLocation& location, ProblemList& problems) {
  const double needed = least_memory(expected.blocks, expected.box_pairs);
  const std::optional<double> available = available_memory();
  if (!available || expected.blocks > most_blocks || needed <= *available) return true;
  const auto about = [](double number) { return rounded(std::round(number)); };
  problems.error(location,
                 "the domain would be cut into about " + about(expected.blocks) + " blocks, " +
                     about(expected.box_pairs) +
                     " pairs of them with boxes that overlap: they take more than " + bytes_text(needed) +
                     " of memory, " + bytes_text(*available) + " are available",
                 "wider spacings, joints across slender blocks or a smaller domain make fewer");
  return false;
}

/// The cure of an Error stands in brackets at its end.
void report(const std::string& message, const SourceLocation& location, ProblemList& problems) {
  const std::size_t cure = message.rfind(" (");
  if (cure == std::string::npos) return problems.error(location, message, "change the domain");
  problems.error(location, message.substr(0, cure), message.substr(cure + 2, message.size() - cure - 3));
}

/// A line of a drawing as a joint: of the law that its layer names, or its number in Shi's files.
void add_drawn_line(const DrawnLine& line, bool is_shi, const Document& document, DomainRecord& domain,
                    std::set<std::string>& unknown_layers) {
  TraceRecord& trace = domain.traces.emplace_back();
  trace.locations.table = line.location;
  const Index n = line.points.cols();
  trace.points.points.resize(2, n + line.closed);
  trace.points.points.leftCols(n) = line.points;
  if (line.closed) trace.points.points.col(n) = line.points.col(0);
  trace.points.locations.assign(static_cast<std::size_t>(n + line.closed), line.location);
  const int number = is_shi && line.layer != "boundary" ? std::stoi(line.layer) - 1 : -1;
  const auto is_layer = [&](const JointRecord& joint) { return joint.name == line.layer; };
  if (number >= 0 && number < static_cast<int>(document.joints.size()))
    trace.joint = Reference{"", number};
  else if (std::ranges::any_of(document.joints, is_layer))
    trace.joint = Reference{line.layer, {}};
  else if (!line.layer.empty() && line.layer != "0")
    unknown_layers.insert(line.layer);
}

/// The boundary and the joints of a drawing.
bool take_drawing(const std::string& path, const std::string& text, Document& document,
                  ProblemList& problems) {
  DomainRecord& domain = *document.domain;
  const Drawing drawing = read_drawing(path, text, problems);
  const DrawnLine* boundary = boundary_of(drawing, path, problems);
  if (!drawing.complete || !boundary) return false;
  domain.boundary.outline.points = boundary->points;
  std::set<std::string> unknown_layers;
  for (const DrawnLine& line : drawing.lines)
    if (&line != boundary)
      add_drawn_line(line, small_ending(path) == ".geo", document, domain, unknown_layers);
  for (const std::string& layer : unknown_layers)
    problems.warning(domain.locations.of("boundary"),
                     "no joint is called '" + excerpt(layer) + "', as a layer of '" + path + "' is",
                     "its lines follow the law of the materials: add [[joint]] with that name");
  return true;
}

/// False: the boundary is not known, and a problem says why.
bool read_boundary(const std::filesystem::path& directory, Document& document, bool& unreadable,
                   ProblemList& problems) {
  DomainRecord& domain = *document.domain;
  if (domain.boundary.file.empty()) return true;
  const SourceLocation& key = domain.locations.of("boundary");
  const std::string path = (directory / domain.boundary.file).string();
  if (is_drawing(path)) {
    const FileText file = read_text(path);
    if (file.text) return take_drawing(path, *file.text, document, problems);
    problems.error(key, "'boundary' = '" + path + "' cannot be read: " + file.reason,
                   "the path is relative to the scene's");
    unreadable = true;
    return false;
  }
  GeometryBlocks file = read_geometry_file(path, key, problems, "boundary");
  unreadable = file.unreadable;
  if (!file.complete) return false;
  if (file.blocks.size() > 1)
    problems.error(key, "'" + path + "' holds " + std::to_string(file.blocks.size()) + " polygons",
                   "a boundary is one polygon: write 'blocks' at the top of the file for several blocks");
  if (file.blocks.size() > 1 || !file.blocks.front().locations.good("vertices")) return false;
  domain.boundary.outline = file.blocks.front().vertices;
  return true;
}

bool meets(const Points& polygon, const Points& line) {
  for (Index k = 0; k < line.cols(); ++k)
    if (polyfem::contains(polygon, line.col(k))) return true;
  for (Index k = 0; k + 1 < line.cols(); ++k)
    for (Index e = 0; e < polygon.cols(); ++e)
      if (polyfem::segments_intersect(line.col(k), line.col(k + 1), polygon.col(e),
                                      polygon.col((e + 1) % polygon.cols())))
        return true;
  return false;
}

/// Two polygons.
bool overlap(const Points& a, const Points& b) {
  Points ring(2, b.cols() + 1);
  ring << b, b.col(0);
  return meets(a, ring) || polyfem::contains(b, a.col(0));
}

/// Openings, regions and traces.
void warn_of_what_is_outside(const Domain& domain, const DomainRecord& record, ProblemList& problems) {
  const auto warn = [&](const KeyLocations& locations, const std::string& what) {
    problems.warning(locations.table, what + " outside the domain and has no effect",
                     "compare its coordinates with the boundary's: the same unit, the same origin?");
  };
  for (std::size_t o = 0; o < record.openings.size(); ++o)
    if (!overlap(domain.boundary, domain.openings[o].outline))
      warn(record.openings[o].locations, "the opening '" + excerpt(record.openings[o].name) + "' lies");
  for (std::size_t r = 0; r < record.regions.size(); ++r)
    if (!overlap(domain.boundary, domain.regions[r].polygon))
      warn(record.regions[r].locations, "the region '" + excerpt(record.regions[r].name) + "' lies");
  const TraceRecord* first = nullptr;
  int n_traces = 0;
  for (std::size_t t = 0; t < record.traces.size(); ++t) {
    if (meets(domain.boundary, domain.traces[t].points)) continue;
    if (n_traces++ == 0) first = &record.traces[t];
  }
  if (n_traces == 1) warn(first->locations, "the trace lies");
  if (n_traces > 1)
    warn(first->locations, "the trace, with " + std::to_string(n_traces - 1) +
                               (n_traces > 2 ? " others," : " other,") + " lies");
}

/// Openings that lines were snapped over.
void warn_of_lost_openings(const CutDomain& cut, const Domain& domain, const DomainRecord& record,
                           ProblemList& problems) {
  std::vector<bool> has_block(record.openings.size(), false);
  for (const CutBlock& block : cut.blocks)
    for (const int o : block.openings) has_block[o] = true;
  for (std::size_t o = 0; o < record.openings.size(); ++o)
    if (!has_block[o] && overlap(domain.boundary, domain.openings[o].outline))
      problems.warning(record.openings[o].locations.table,
                       "the opening '" + excerpt(record.openings[o].name) +
                           "' is smaller than what lines are snapped by and has no effect",
                       "write a smaller 'snap' in [domain], or a larger opening");
}

}  // namespace

bool add_domain(const std::filesystem::path& directory, Document& document, ProblemList& problems) {
  if (!document.domain) return true;
  const bool all = document.has_all_blocks;
  document.has_all_blocks = false;
  const bool is_good = document.locations.good("domain");
  bool unreadable = false;
  if (document.domain->locations.good("boundary") &&
      !read_boundary(directory, document, unreadable, problems))
    return !unreadable;
  const std::size_t n_problems = problems.size();
  const DomainReader reader(document, problems);
  if (!is_good || problems.size() != n_problems) return true;
  const ExpectedCut expected = expected_cut(reader.domain());
  const SourceLocation& size = place_of_size(expected, *document.domain);
  if (!fits_into_memory(expected, size, problems)) return true;
  try {
    const CutDomain cut = cut_domain(reader.domain());
    for (std::size_t b = 0; b < cut.blocks.size(); ++b)
      if (auto block = reader.block(cut.blocks[b], b)) document.blocks.push_back(std::move(*block));
    warn_of_what_is_outside(reader.domain(), *document.domain, problems);
    warn_of_lost_openings(cut, reader.domain(), *document.domain, problems);
    if (document.blocks.empty())
      problems.error(document.domain->locations.of("boundary"), "nothing of the domain is left",
                     "smaller openings, or a smaller 'snap' and 'sliver'");
    document.domain_counts = cut.counts;
    document.has_all_blocks = all;
  } catch (const TooManyBlocks& error) {
    report(error.what(), size, problems);
  } catch (const polyfem::Error& error) {
    report(error.what(), document.domain->locations.of("boundary"), problems);
  }
  return true;
}

}  // namespace ddacontact::scene_format
