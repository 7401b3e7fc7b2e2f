#include <ddacontact/scene/resolve_bolts.hpp>

#include <ddacontact/scene/bolt_path.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact::scene_format {

namespace {

/// A bolt is at most so many times as long as the length over which its force fades, and at least so many:
/// its slips are lost in round-off else.
constexpr double most_bond_lengths = 100, least_bond_lengths = 1e-4;

class BoltCheck {
 public:
  BoltCheck(const BoltRecord& record, const BlockTable& blocks,
            const std::vector<BlockDescription>& descriptions, ProblemList& problems)
      : record_(record),
        locations_(record.locations),
        bolt_(record.bolt),
        blocks_(blocks),
        descriptions_(descriptions),
        problems_(problems) {
    bolt_.name = record.name;
    bolt_.bond_stiffness = record.bond_stiffness.value_or(0);
  }

  RockBolt bolt() const { return bolt_; }

  /// What does not depend on the blocks. False: where it runs is not known.
  bool check_keys() {
    const bool grouted = bolt_.kind == RockBolt::Kind::grouted;
    if (grouted && !locations_.written("bond_stiffness"))
      problems_.error(locations_.table, "missing key 'bond_stiffness' in [[bolt]]",
                      "a bolt of type \"grouted\" has one, in N/m2");
    for (const char* key : {"bond_stiffness", "bond_strength"})
      if (!grouted && locations_.usable("type") && locations_.written(key))
        problems_.error(locations_.of(key),
                        std::string("'") + key + "' does not belong to a bolt of type 'anchored'",
                        "leave it out, or write type = \"grouted\"");
    check_forces();
    if (!locations_.good("points")) return false;
    const Points& points = record_.points.points;
    if (points.cols() != 2) {
      problems_.error(locations_.of("points"), "'points' holds " + std::to_string(points.cols()) + " points",
                      "a bolt runs straight between two: points = [[x, y], [x, y]]");
      return false;
    }
    bolt_.from = points.col(0);
    bolt_.to = points.col(1);
    if (bolt_.from != bolt_.to) return locations_.usable("type");
    problems_.error(locations_.of("points"),
                    "the bolt has no length: both its ends are at " + text(bolt_.from), "move one of them");
    return false;
  }

  /// Returns the blocks that it holds together; none: they are not as they should be.
  std::vector<int> find_blocks() {
    const std::size_t n_problems = problems_.size();
    std::vector<int> blocks = bolt_.kind == RockBolt::Kind::grouted ? passed() : ends();
    if (problems_.size() > n_problems) return {};
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    if (blocks.size() < 2)
      problems_.error(locations_.of("points"),
                      "the bolt lies in " + blocks_.names.title(blocks.front()) + " alone",
                      "let it join two blocks");
    else if (std::ranges::all_of(blocks, [&](int b) { return descriptions_[b].fixed; }))
      problems_.error(locations_.of("points"), "the bolt joins blocks that are all fixed",
                      "let it join one that may move, or leave it out");
    return blocks;
  }

 private:
  static std::string text(const Vec2& x) {
    return "(" + short_number(x.x()) + ", " + short_number(x.y()) + ")";
  }

  void check_forces() {
    if (!locations_.good("pretension")) return;
    if (locations_.good("yield_force") && bolt_.pretension > *bolt_.yield_force)
      problems_.error(locations_.of("pretension"), "'pretension' is larger than 'yield_force'",
                      "at most " + short_number(*bolt_.yield_force) + " N");
    if (locations_.good("rupture_strain") && locations_.good("area") && locations_.good("young") &&
        bolt_.pretension > *bolt_.rupture_strain * bolt_.area * bolt_.young)
      problems_.error(locations_.of("pretension"), "'pretension' strains the bar beyond 'rupture_strain'",
                      "at most " + short_number(*bolt_.rupture_strain * bolt_.area * bolt_.young) + " N");
  }

  /// The blocks that hold an end; none, and a problem, where there is none.
  std::vector<int> at(const Vec2& end, std::size_t which) {
    std::vector<int> found = blocks_at(end, descriptions_);
    if (!found.empty()) return found;
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < descriptions_.size(); ++b) {
      const double distance = distance_to_outline(end, descriptions_[b].vertices);
      if (distance >= least) continue;
      least = distance;
      nearest = static_cast<int>(b);
    }
    problems_.error(record_.points.locations[which],
                    "the end of the bolt at " + text(end) + " lies outside all blocks",
                    "move it into a block or onto its outline; the nearest is " +
                        blocks_.names.title(nearest) + ", " + rounded(least) + " m away");
    return found;
  }

  std::vector<int> ends() {
    std::vector<int> all;
    for (std::size_t which : {0, 1}) {
      const std::vector<int> found = at(which == 0 ? bolt_.from : bolt_.to, which);
      if (found.size() > 1)
        problems_.error(record_.points.locations[which],
                        "the end of the bolt lies on the face between " + blocks_.names.title(found[0]) +
                            " and " + blocks_.names.title(found[1]),
                        "move it into the block that it is fixed in");
      if (found.size() == 1) all.push_back(found.front());
    }
    return all;
  }

  std::vector<int> passed() {
    const std::vector<int> first = at(bolt_.from, 0), last = at(bolt_.to, 1);
    if (first.empty() || last.empty()) return {};
    const std::vector<BoltPiece> pieces = bolt_pieces(bolt_, descriptions_);
    std::vector<int> all;
    double reached = 0, bonded = 0;
    const double length = (bolt_.to - bolt_.from).norm();
    for (const BoltPiece& piece : pieces) {
      if (reached - piece.from > bolt_tolerance * length && !all.empty())
        problems_.error(locations_.of("points"),
                        "the bolt runs along the face between " + blocks_.names.title(all.back()) + " and " +
                            blocks_.names.title(piece.block),
                        "turn or move it a little");
      all.push_back(piece.block);
      reached = piece.to;
      bonded += piece.to - piece.from;
    }
    if (all.empty())
      problems_.error(locations_.of("points"), "the bolt runs along faces and passes no block",
                      "turn or move it a little");
    if (bolt_.bond_stiffness <= 0 || bolt_.area <= 0 || bolt_.young <= 0) return all;
    const double bond_lengths = bonded / std::sqrt(bolt_.area * bolt_.young / bolt_.bond_stiffness);
    if (bond_lengths > most_bond_lengths)
      problems_.error(locations_.of("bond_stiffness"),
                      "the bolt is more than " + short_number(most_bond_lengths) +
                          " times as long as its force needs to fade in the bond",
                      "take a smaller 'bond_stiffness', or an anchored bolt");
    else if (bond_lengths < least_bond_lengths)
      problems_.error(locations_.of("bond_stiffness"), "the bond is too soft for the bar to bear anything",
                      "take a larger 'bond_stiffness', or leave the bolt out");
    return all;
  }

  const BoltRecord& record_;
  const KeyLocations& locations_;
  RockBolt bolt_;
  const BlockTable& blocks_;
  const std::vector<BlockDescription>& descriptions_;
  ProblemList& problems_;
};

}  // namespace

ResolvedBolts resolve_bolts(const Document& document, const BlockTable& blocks,
                            const std::vector<BlockDescription>& descriptions, ContactMethod method,
                            ProblemList& problems) {
  ResolvedBolts resolved;
  const bool blocks_known =
      document.has_all_blocks && !descriptions.empty() &&
      std::ranges::all_of(blocks.outlines, [](const PositionedOutline& of) { return of.outline.valid(); });
  for (const BoltRecord& record : document.bolts) {
    resolved.names.add(record.name, record.locations, problems);
    if (method == ContactMethod::classic)
      problems.error(record.locations.table, "bolts need the contact method 'staged'",
                     "write method = \"staged\" in [contact]");
    BoltCheck check(record, blocks, descriptions, problems);
    resolved.blocks.emplace_back();
    if (check.check_keys() && blocks_known) resolved.blocks.back() = check.find_blocks();
    resolved.bolts.push_back(check.bolt());
  }
  return resolved;
}

void bring_bolts(const Document& document, const ResolvedBolts& bolts, const BlockTable& blocks,
                 std::vector<StageDescription>& stages, ProblemList& problems) {
  for (int bolt = 0; bolt < static_cast<int>(bolts.blocks.size()); ++bolt) {
    const std::vector<int>& held = bolts.blocks[bolt];
    if (held.empty()) continue;
    const auto comes = [&](int block) { return blocks.outlines[block].comes; };
    const int last = std::ranges::max(held, {}, comes);
    const auto own = std::ranges::find_if(
        stages, [&](const StageDescription& stage) { return std::ranges::count(stage.bolts, bolt) > 0; });
    const int in = own == stages.end() ? comes(last) : static_cast<int>(own - stages.begin());
    if (in < 0) continue;
    const SourceLocation& location =
        own == stages.end() ? document.bolts[bolt].locations.table : document.stages[in].locations.of("add");
    const auto gone =
        std::ranges::find_if(held, [&](int block) { return blocks.outlines[block].goes <= in; });
    if (gone != held.end()) {
      const bool grouted = document.bolts[bolt].bolt.kind == RockBolt::Kind::grouted;
      const auto complain = grouted ? &ProblemList::warning : &ProblemList::error;
      (problems.*complain)(location,
                           bolts.names.title(bolt) + " comes in when " + blocks.names.title(*gone) +
                               ", which it is fixed in, is gone",
                           grouted ? "its part there is left out: let it begin behind"
                                   : "end it in a block that is there then, or add it before");
    } else if (in < comes(last)) {
      problems.error(
          location,
          bolts.names.title(bolt) + " comes in before " + blocks.names.title(last) + ", which it is fixed in",
          "add it in the stage that adds the block, or later");
    }
    if (own == stages.end()) stages[in].bolts.push_back(bolt);
  }
}

}  // namespace ddacontact::scene_format
