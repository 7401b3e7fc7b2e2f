#include "results.hpp"

#include <ddacontact/output/summary_reader.hpp>

#include <algorithm>

namespace step_performance {

Measurement measurement_of_result(const std::filesystem::path& directory) {
  const ddacontact::SummaryTable summary = ddacontact::read_summary(directory / "summary.json");
  const auto number = [&](const char* key) { return summary.number(key).value_or(0); };
  Measurement row;
  row.scene = directory.lexically_normal().string();
  std::ranges::replace(row.scene, ',', ';');
  row.status = summary.text("status") == "completed" ? "done" : summary.text("reason");
  std::ranges::replace(row.status, ',', ';');
  row.blocks = number("blocks");
  row.unknowns = number("dofs");
  row.steps = number("steps_completed");
  row.threads = std::max(1., number("threads"));
  row.contacts = number("contacts_end");
  row.setup = number("wall_seconds.setup");
  row.peak = number("peak_memory_mb") * 1.048576;
  if (row.steps == 0) return row;
  row.time_step = number("time") / row.steps;
  const auto each = [&](const char* key) { return number(key) / row.steps; };
  row.total = row.mean = each("wall_seconds.steps");
  row.detection = each("wall_seconds.detection");
  row.assembly = each("wall_seconds.assembly");
  row.analysis = each("wall_seconds.analysis");
  row.factorization = each("wall_seconds.factorization");
  row.solution = each("wall_seconds.solution");
  row.solver = each("wall_seconds.solver") - row.linear();
  row.update = each("wall_seconds.update");
  row.rest = row.total - row.detection - row.assembly - row.solver - row.linear() - row.update;
  row.output = each("wall_seconds.output");
  row.substeps = each("substeps");
  row.rejected = each("rejected_steps");
  row.iterations = each("open_close_iterations");
  row.linear_solves = each("linear_solves");
  row.factorizations = each("factorizations");
  row.analyses = each("analyses");
  return row;
}

}  // namespace step_performance
