#include <ddacontact/scene/resolve_water.hpp>

#include <ddacontact/scene/text.hpp>

namespace ddacontact::scene_format {

namespace {

void check_table(const std::optional<Outline>& table, const char* key, const KeyLocations& locations,
                 ProblemList& problems) {
  if (!locations.good(key)) return;
  if (table->points.cols() == 0)
    problems.error(locations.of(key), "'" + std::string(key) + "' has no points", "write [[x, y], ...]");
  for (Index k = 1; k < table->points.cols(); ++k)
    if (!(table->points(0, k) > table->points(0, k - 1)))
      problems.error(table->locations[k],
                     "the table turns back at x = " + short_number(table->points(0, k)) + " m",
                     "give its points from left to right, each x once");
}

/// Where a key is written, in the stage or else in [water].
Water water_of(const WaterRecord& record, const WaterRecord* before, const Vec2& gravity,
               ProblemList& problems) {
  const auto chosen = [&](auto WaterRecord::*key) {
    return record.*key || !before ? record.*key : before->*key;
  };
  check_table(record.table, "table", record.locations, problems);
  check_table(record.joint_table, "joint_table", record.locations, problems);
  const std::optional<Outline> table = chosen(&WaterRecord::table),
                               joint_table = chosen(&WaterRecord::joint_table);
  const bool joints = chosen(&WaterRecord::joints).value_or(true);
  if (!table && !record.locations.written("table"))
    problems.error(record.locations.table, "water without 'table'", "add 'table' = [[x, y], ...]");
  if (!joints && record.joint_table && record.locations.usable("joints"))
    problems.error(record.locations.of("joint_table"), "'joint_table' where 'joints' is false",
                   "leave one of them out");
  if (gravity.y() >= 0)
    problems.error(record.locations.table, "water has no weight: gravity does not point down",
                   "write 'gravity' = [0, -9.8] in [analysis]");
  if (gravity.x() != 0)
    problems.warning(
        record.locations.table, "gravity is inclined: the weight of water follows its vertical part alone",
        "right for an earthquake; if the ground is inclined, turn the blocks instead of gravity");
  Water water;
  water.density = chosen(&WaterRecord::density).value_or(water.density);
  if (table) water.table = table->points;
  if (joints) water.joint_table = joint_table ? joint_table->points : water.table;
  return water;
}

}  // namespace

Water resolve_water(const Document& document, ProblemList& problems) {
  if (!document.water) return {};
  return water_of(*document.water, nullptr, document.analysis.options.gravity, problems);
}

Water changed_water(const StageRecord& stage, const Document& document, const AnalysisOptions& analysis,
                    ProblemList& problems) {
  const WaterRecord* before = document.water ? &*document.water : nullptr;
  if (stage.water) return water_of(*stage.water, before, analysis.gravity, problems);
  if (!before) return {};
  ProblemList known(problems.file());
  return water_of(*before, nullptr, analysis.gravity, known);
}

}  // namespace ddacontact::scene_format
