#include <ddacontact/scene/resolve_stages.hpp>

#include <ddacontact/scene/resolve_options.hpp>
#include <ddacontact/scene/resolve_water.hpp>

#include <algorithm>
#include <limits>

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

/// Since which stage bolts are there.
class Installations {
 public:
  Installations(const NameTable& bolts, const NameTable& stages, ProblemList& problems)
      : bolts_(bolts), stages_(stages), problems_(problems), since_(bolts.size(), -1) {}

  /// The bolts that a stage installs; those that are there already are a problem.
  std::vector<int> operator()(const StageRecord& record, int stage) {
    std::vector<int> installed;
    const SourceLocation& location = record.locations.of("add");
    for (const std::string& name : record.add) {
      const int bolt = bolts_.find({name, {}}, location, problems_);
      if (bolt < 0) continue;
      if (since_[bolt] >= 0) {
        const bool here = since_[bolt] == stage;
        problems_.error(
            location,
            bolts_.title(bolt) + (here ? " stands twice" : " is there since " + stages_.title(since_[bolt])),
            "add each bolt once");
        continue;
      }
      since_[bolt] = stage;
      installed.push_back(bolt);
    }
    return installed;
  }

 private:
  const NameTable& bolts_;
  const NameTable& stages_;
  ProblemList& problems_;
  std::vector<int> since_;  ///< of each bolt; < 0: no stage
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

}  // namespace

std::vector<StageDescription> resolve_stages(const Document& document, const NamedJoints& joints,
                                             const BlockTable& blocks, const NameTable& bolts,
                                             ContactMethod method, ProblemList& problems) {
  NameTable names("stage");
  Removals removals(blocks, names, problems);
  Installations installations(bolts, names, problems);
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
    stage.joints = changed_joints(record, joints, document.contact, method, problems);
    stage.reset_displacements = record.reset_displacements;
    stage.until = record.until;
    stage.water = changed_water(record, document, stage.analysis, problems);
    stage.removed = removals(record.remove, index);
    stage.bolts = installations(record, index);
    if (!stage.removed.empty() && document.has_all_blocks && removals.leave_nothing())
      problems.error(locations.of("remove"), names.title(index) + " leaves no block", "leave one at least");
  }
  return stages;
}

}  // namespace ddacontact::scene_format
