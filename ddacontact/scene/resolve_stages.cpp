#include <ddacontact/scene/resolve_stages.hpp>

#include <ddacontact/scene/resolve_options.hpp>
#include <ddacontact/scene/resolve_water.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace ddacontact::scene_format {

namespace {

/// Which blocks are gone, and since which stage.
class Removals {
 public:
  Removals(const BlockTable& blocks, const NameTable& stages, ProblemList& problems)
      : blocks_(blocks), stages_(stages), problems_(problems), since_(blocks.names.size(), -1) {}

  /// The blocks that a stage takes out; those that are gone already are a problem.
  std::vector<int> operator()(const BlockList& list, int stage) {
    std::vector<int> removed;
    for (std::size_t i = 0; i < list.blocks.size(); ++i) {
      const SourceLocation& location = list.locations[i];
      const int block = blocks_.names.find(list.blocks[i], location, problems_);
      if (block < 0) continue;
      if (since_[block] >= 0) {
        const bool here = since_[block] == stage;
        problems_.error(location,
                        blocks_.names.title(block) +
                            (here ? " stands twice" : " is gone since " + stages_.title(since_[block])),
                        "remove each block once");
        continue;
      }
      since_[block] = stage;
      removed.push_back(block);
    }
    return removed;
  }

  bool leave_nothing() const {
    return std::none_of(since_.begin(), since_.end(), [](int stage) { return stage < 0; });
  }

 private:
  const BlockTable& blocks_;
  const NameTable& stages_;
  ProblemList& problems_;
  std::vector<int> since_;  ///< of each block; < 0: it stays
};

/// What comes in by stages, and since which.
class Arrivals {
 public:
  Arrivals(const BlockTable& blocks, const std::vector<BlockDescription>& descriptions,
           const NameTable& bolts, const Document& document, const NameTable& stages, ProblemList& problems)
      : blocks_(blocks),
        descriptions_(descriptions),
        bolts_(bolts),
        document_(document),
        stages_(stages),
        problems_(problems) {}

  /// What a stage brings; what is there already is a problem.
  void operator()(const BlockList& list, int index, StageDescription& stage) {
    for (std::size_t i = 0; i < list.blocks.size(); ++i) {
      const Reference& one = list.blocks[i];
      const SourceLocation& location = list.locations[i];
      if (!one.index && bolts_.knows(one.name)) {
        const int bolt = bolts_.find(one, location, problems_);
        arrive(bolts_.title(bolt), bolt, since_of_bolts_, index, location, stage.bolts);
        continue;
      }
      if (!one.index && !blocks_.names.knows(one.name) && is_load(one.name)) {
        for (std::size_t l = 0; l < document_.loads.size(); ++l)
          if (document_.loads[l].name == one.name)
            arrive("load '" + one.name + "'", static_cast<int>(l), since_of_loads_, index, location,
                   stage.loads);
        continue;
      }
      if (!one.index && !blocks_.names.knows(one.name)) {
        problems_.error(location, "unknown block, bolt or load '" + excerpt(one.name) + "'",
                        suggestion(one.name, "block, bolt or load", known()));
        continue;
      }
      const int block = blocks_.names.find(one, location, problems_);
      if (block < 0) continue;
      const BlockDescription& description = descriptions_[block];
      if (!description.velocity.isZero(0) || description.angular_velocity != 0)
        problems_.error(location, blocks_.names.title(block) + " comes in with a velocity",
                        "leave its velocity out: blocks come in at rest");
      if (document_.initial_stress && !document_.blocks[block].locations.written("stress"))
        problems_.warning(location,
                          blocks_.names.title(block) + " comes in with the stress of [initial_stress]",
                          "give it a 'stress' of its own, [0, 0, 0] if it is built then");
      arrive(blocks_.names.title(block), block, since_of_blocks_, index, location, stage.added);
    }
  }

  /// The stage that a block comes in with; -1: it is there from the start.
  int of_block(int block) const {
    const auto found = since_of_blocks_.find(block);
    return found == since_of_blocks_.end() ? -1 : found->second;
  }

 private:
  std::vector<std::string_view> known() const {
    std::vector<std::string_view> names;
    for (const BlockDescription& block : descriptions_)
      if (!block.name.empty()) names.emplace_back(block.name);
    for (const BoltRecord& bolt : document_.bolts) names.emplace_back(bolt.name);
    for (const LoadRecord& load : document_.loads)
      if (load.name) names.emplace_back(*load.name);
    return names;
  }

  bool is_load(const std::string& name) const {
    return std::ranges::any_of(document_.loads, [&](const LoadRecord& load) { return load.name == name; });
  }

  void arrive(const std::string& title, int number, std::map<int, int>& since, int stage,
              const SourceLocation& location, std::vector<int>& arrived) {
    const auto [known, is_new] = since.emplace(number, stage);
    if (is_new) return arrived.push_back(number);
    problems_.error(location,
                    title + (known->second == stage ? " stands twice"
                                                    : " is there since " + stages_.title(known->second)),
                    "add each once");
  }

  const BlockTable& blocks_;
  const std::vector<BlockDescription>& descriptions_;
  const NameTable& bolts_;
  const Document& document_;
  const NameTable& stages_;
  ProblemList& problems_;
  std::map<int, int> since_of_bolts_, since_of_loads_, since_of_blocks_;
};

/// Steps are counted over all stages.
void check_n_steps(const StageRecord& record, std::int64_t& n_steps, ProblemList& problems) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  const bool were_fewer = n_steps <= most;
  n_steps += record.steps;
  if (n_steps > most && were_fewer)
    problems.error(record.locations.of("steps"),
                   "with these 'steps' the stages have '" + std::to_string(n_steps) + "' in all",
                   "at most " + std::to_string(most) + " can be counted");
}

/// There are forces to relax, and steps to do so.
void check_relaxation(const StageRecord& record, bool has_forces, ProblemList& problems) {
  const KeyLocations& locations = record.locations;
  if (!record.relax || !locations.usable("relax")) return;
  if (!locations.written("remove"))
    problems.error(locations.of("relax"), "'relax' without 'remove'",
                   "it is for the forces of blocks that are taken out: leave it out");
  else if (!has_forces)
    problems.error(locations.of("relax"), "'relax' in the first stage: there are no forces yet",
                   "let a stage before it bring the blocks to rest");
  else if (locations.good("steps") && *record.relax > record.steps)
    problems.error(
        locations.of("relax"),
        "'relax' = '" + std::to_string(*record.relax) + "' of " + std::to_string(record.steps) + " 'steps'",
        "give the stage more steps, best some after the forces are gone");
}

}  // namespace

std::vector<StageDescription> resolve_stages(const Document& document, const Scene& scene,
                                             const NamedJoints& joints, const BlockTable& blocks,
                                             const NameTable& bolts, ProblemList& problems) {
  NameTable names("stage");
  Removals removals(blocks, names, problems);
  Arrivals arrivals(blocks, scene.blocks, bolts, document, names, problems);
  std::int64_t n_steps = 0;
  std::vector<StageDescription> stages;
  for (const StageRecord& record : document.stages) {
    const int index = names.size();
    const KeyLocations& locations = record.locations;
    names.add(record.name, locations, problems);
    StageDescription& stage = stages.emplace_back();
    stage.name = record.name.value_or("");
    stage.analysis = resolve_analysis(document.analysis, record, problems);
    stage.analysis.skip = document.solver.skip;
    check_n_steps(record, n_steps, problems);
    stage.joints = changed_joints(record, joints, document.contact, scene.contact.method, problems);
    stage.reset_displacements = record.reset_displacements;
    stage.until = record.until;
    stage.water = changed_water(record, document, stage.analysis, problems);
    stage.removed = removals(record.remove, index);
    stage.relax = record.relax;
    check_relaxation(record, document.goes_on || index > 0, problems);
    arrivals(record.add, index, stage);
    if (!stage.removed.empty() && document.has_all_blocks && removals.leave_nothing())
      problems.error(locations.of("remove"), names.title(index) + " leaves no block", "leave one at least");
  }
  std::vector<bool> is_gone(static_cast<std::size_t>(blocks.names.size()), false);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    for (const int block : stages[k].removed) is_gone[block] = true;
    for (const int load : stages[k].loads) {
      const SourceLocation& location = document.stages[k].locations.of("add");
      const int block = blocks.names.find(document.loads[load].block, location, problems);
      if (block >= 0 && is_gone[block])
        problems.error(location,
                       "load '" + excerpt(*document.loads[load].name) + "' is on " +
                           blocks.names.title(block) + ", which is gone by then",
                       "leave it out of 'add'");
    }
  }
  for (std::size_t k = 0; k < stages.size(); ++k)
    for (const int block : stages[k].removed)
      if (arrivals.of_block(block) >= static_cast<int>(k))
        problems.error(document.stages[k].locations.of("remove"),
                       blocks.names.title(block) + " is not there yet: it comes in with " +
                           names.title(arrivals.of_block(block)),
                       "remove it in a later stage");
  return stages;
}

}  // namespace ddacontact::scene_format
