/// \file The program `dda`: one verb, one file.
#include "call_error.hpp"
#include "check.hpp"
#include "cut.hpp"
#include "exit_status.hpp"
#include "help.hpp"
#include "info.hpp"
#include "make.hpp"
#include "messages.hpp"
#include "plot_options.hpp"
#include "run.hpp"
#include "safety.hpp"
#include "sweep.hpp"
#include "view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <string_view>

namespace {

struct Call {
  dda::RunArguments run;
  dda::MakeArguments make;
  dda::CutArguments cut;
  dda::PlotArguments plot;
  dda::SafetyArguments safety;
  dda::SweepArguments sweep;
  dda::ViewArguments view;
  std::string info, help_topic;
  std::vector<std::string> scenes_to_check, check_settings;
  int steps = 0;
};

constexpr std::array<std::string_view, 11> known_verbs{"run",  "check",  "make",  "cut",  "plot",  "view",
                                                       "info", "safety", "sweep", "help", "schema"};

bool is_known(std::string_view verb) {
  return std::find(known_verbs.begin(), known_verbs.end(), verb) != known_verbs.end();
}

int execute(const CLI::App& app, Call& call) {
  if (app.got_subcommand("check")) return dda::check(call.scenes_to_check, call.check_settings);
  if (app.got_subcommand("make")) return dda::make(call.make);
  if (app.got_subcommand("cut")) return dda::cut(call.cut);
  if (app.got_subcommand("plot")) return dda::plot(call.plot);
  if (app.got_subcommand("view")) return dda::view(call.view);
  if (app.got_subcommand("safety")) return dda::safety(call.safety);
  if (app.got_subcommand("sweep")) return dda::sweep(call.sweep);
  if (app.got_subcommand("info")) return dda::info(call.info);
  if (app.got_subcommand("help")) return dda::help(app, call.help_topic);
  if (app.got_subcommand("schema")) return dda::schema();
  if (call.steps > 0) call.run.steps = call.steps;
  return dda::run(call.run);
}

void declare_run_and_check(CLI::App& app, Call& call) {
  CLI::App* run = app.add_subcommand("run", "Run a scene and write its results");
  run->add_option("SCENE", call.run.scene, "Scene file (TOML)")->required();
  run->add_option("-o,--output", call.run.directory,
                  "Result directory; left out: SCENE without its ending, plus -out");
  run->add_option("--steps", call.steps, "Stop after this many steps from the start of the scene")
      ->check(CLI::Range(1, 2'000'000'000));
  run->add_option("--set", call.run.settings, "PATH=VALUE: replace a value of the scene")
      ->take_all()
      ->expected(1);
  CLI::Option* resume =
      run->add_option("--resume", call.run.checkpoint, "Checkpoint of the same scene to go on from");
  run->add_flag("--as-stage", call.run.as_stage,
                "Continue from the checkpoint as a new stage, with other loads, joint strengths or schedule")
      ->needs(resume);
  run->add_option("--threads", call.run.threads,
                  "Threads that share the work on blocks, contacts and frames; results are the same for any "
                  "number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  run->add_flag("--force", call.run.force, "Overwrite older results instead of renaming them");
  run->add_flag("--quiet", call.run.quiet, "Print problems only");

  CLI::App* check = app.add_subcommand("check", "Read and check scenes, compute nothing");
  check->add_option("SCENE", call.scenes_to_check, "Scene files (TOML)")->required();
  check->add_option("--set", call.check_settings, "PATH=VALUE: replace a value of the scenes")
      ->take_all()
      ->expected(1);
}

/// What is wrong with the verb or the word after it; empty: nothing that the parser does not tell better.
std::string problem_of_words(std::string_view verb, const std::string& next) {
  if (verb.empty() || verb.front() == '-' || is_known(verb))
    return verb == "make" ? dda::problem_of_kind(next) : "";
  const std::vector<std::string_view> known(known_verbs.begin(), known_verbs.end());
  return fmt::format("unknown verb \"{}\" ({})", verb, dda::choice_among(verb, known));
}

int parse_and_execute(int argc, char** argv) {
  CLI::App app{"Discontinuous deformation analysis of blocks in contact"};
  app.name("dda");
  app.set_version_flag("--version", POLYDDA_VERSION);
  app.require_subcommand(1);
  Call call;

  declare_run_and_check(app, call);
  dda::add_make(app, call.make);
  dda::add_cut(app, call.cut);
  dda::declare_plot(app, call.plot);
  dda::add_view(app, call.view);
  dda::add_safety(app, call.safety);
  dda::add_sweep(app, call.sweep);
  CLI::App* info = app.add_subcommand("info", "Describe a result in words");
  info->add_option("DIR", call.info, "Result directory")->required();
  CLI::App* help = app.add_subcommand("help", "Print a topic of the manual");
  help->add_option("TOPIC", call.help_topic,
                   "A table of the scene, units, files, statuses, schemes, completion; left out: the list");
  app.add_subcommand("schema", "Print a JSON schema of the scene, for editors");
  app.footer(dda::help_footer());  // after the verbs, which would inherit it

  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (const std::string problem = problem_of_words(verb, argc > 2 ? argv[2] : ""); !problem.empty()) {
    dda::print_error(problem);
    return dda::wrong_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answered) {
    return app.exit(answered);
  } catch (const CLI::ParseError& error) {
    const bool lacks_verb = verb.empty() || verb.front() == '-';
    const std::string text = verb.empty() ? "no verb is given" : error.what();
    dda::print_error(fmt::format("{} (try dda {}--help)", text, lacks_verb ? "" : std::string(verb) + ' '));
    return dda::wrong_input;
  }
  return execute(app, call);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_execute(argc, argv);
  } catch (const std::bad_alloc&) {
    dda::print_error("out of memory");
    return dda::analysis_stopped;
  } catch (const std::exception& error) {
    dda::print_error(error.what());
    return dda::analysis_stopped;
  }
}
