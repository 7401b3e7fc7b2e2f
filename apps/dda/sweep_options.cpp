#include "option_values.hpp"
#include "sweep.hpp"

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

namespace dda {

std::vector<std::string> SweepArguments::of_safety() const {
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--range", range);
  add("--tolerance", tolerance);
  add("--joints", joints);
  return words;
}

std::optional<std::pair<std::string, std::string>> SweepArguments::curve_columns() const {
  if (curve.empty()) return std::nullopt;
  const std::size_t comma = curve.find(',');
  if (comma == 0 || comma == std::string::npos || comma + 1 == curve.size())
    throw polyfem::Error(fmt::format("--curve \"{}\" names no two columns (write X,Y)", curve));
  return std::pair(curve.substr(0, comma), curve.substr(comma + 1));
}

void add_sweep(CLI::App& app, SweepArguments& arguments) {
  CLI::App* sweep = app.add_subcommand("sweep", "Run a scene with all combinations of settings");
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* type,
                        const char* text) {
    sweep->add_option(name, values, text)->take_all()->expected(1)->type_name(type);
  };
  const auto text = [&](const char* name, std::string& value, const char* type, const char* what) {
    return sweep->add_option(name, value, what)->type_name(type);
  };
  sweep->add_option("SCENE", arguments.scene, "Scene file (TOML)")->required();
  text("-o,--output", arguments.directory, "DIR", "Directory of sweep.csv and of the cases")->required();
  list("--vary", arguments.vary, "PATH=VALUES",
       "VALUES are a,b,c or from:to:count or 1..100 or a list of these; may be repeated");
  text("--table", arguments.table, "FILE", "CSV file whose header names paths and whose rows are cases");
  list("--outcome", arguments.outcomes, "NAME=PATH",
       "A column of sweep.csv: PATH into summary.json, or monitor.NAME.COLUMN at the end; may be repeated");
  list("--set", arguments.settings, "PATH=VALUE",
       "Replace a value of the scene in all cases; may be repeated");
  CLI::Option* safety = sweep->add_flag("--safety", arguments.safety,
                                        "Find the factor of safety of each case: columns factor_low, "
                                        "factor_high and the probability of failure");
  text("--range", arguments.range, "A:B", "Of the factors, as of dda safety")->needs(safety);
  text("--tolerance", arguments.tolerance, "X", "Of the factors, as of dda safety")->needs(safety);
  text("--joints", arguments.joints, "NAME,...", "The joints to weaken, as of dda safety")->needs(safety);
  text("--curve", arguments.curve, "X,Y", "Two columns of sweep.csv, drawn as sweep.svg");
  text("--map", arguments.map, "X,Y,VALUE",
       "A column of sweep.csv over two others, coloured cells drawn as map.svg");
  expect_whole_number(
      sweep->add_option("--jobs", arguments.jobs, "Cases at a time; left out: as many as processors"), 1,
      1024);
  CLI::Option* one = sweep->add_option("--case", arguments.only, "Run only the case of this number");
  expect_whole_number(one, 1);
  sweep->add_flag("--slurm", arguments.slurm, "Write sweep.sbatch, a job array of the cases; run nothing")
      ->excludes(one);
  sweep->add_flag("--quiet", arguments.quiet, "Print problems only");
}

}  // namespace dda
