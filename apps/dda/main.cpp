/// \file The program `dda`: one verb, one file.
#include "call_problem.hpp"
#include "check.hpp"
#include "cut.hpp"
#include "exit_status.hpp"
#include "help.hpp"
#include "info.hpp"
#include "make.hpp"
#include "memory.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "plain_help.hpp"
#include "plot_options.hpp"
#include "run.hpp"
#include "safety.hpp"
#include "sweep.hpp"
#include "thread_waiting.hpp"
#include "view.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace {

struct Call {
  dda::RunArguments run;
  dda::MakeArguments make;
  dda::CutArguments cut;
  dda::PlotArguments plot;
  dda::SafetyArguments safety;
  dda::SweepArguments sweep;
  dda::ViewArguments view;
  std::string info;
  std::vector<std::string> help_words;
  std::vector<std::string> scenes_to_check, check_settings;
  int steps = 0;
};

int execute(const CLI::App& app, Call& call) {
  if (app.got_subcommand("check")) return dda::check(call.scenes_to_check, call.check_settings);
  if (app.got_subcommand("make")) return dda::make(call.make);
  if (app.got_subcommand("cut")) return dda::cut(call.cut);
  if (app.got_subcommand("plot")) return dda::plot(call.plot);
  if (app.got_subcommand("view")) return dda::view(call.view);
  if (app.got_subcommand("info")) return dda::info(call.info);
  if (app.got_subcommand("help")) return dda::help(app, call.help_words);
  if (app.got_subcommand("schema")) return dda::schema();
  std::signal(SIGPIPE, SIG_IGN);  // what takes long is not lost with who reads along
  if (app.got_subcommand("safety")) return dda::safety(call.safety);
  if (app.got_subcommand("sweep")) return dda::sweep(call.sweep);
  if (call.steps > 0) call.run.steps = call.steps;
  return dda::run(call.run);
}

void declare_run_and_check(CLI::App& app, Call& call) {
  CLI::App* run = app.add_subcommand("run", "Run a scene and write its results");
  run->add_option("SCENE", call.run.scene, "Scene file (TOML)")->required();
  run->add_option("-o,--output", call.run.directory,
                  "Result directory; left out: SCENE without its ending, plus -out")
      ->type_name("DIR")
      ->check([](const std::string& word) { return word.empty() ? "needs a name" : ""; }, "");
  dda::expect_whole_number(
      run->add_option("--steps", call.steps, "Stop after this many steps from the start of the scene"), 1);
  run->add_option("--set", call.run.settings, "Replace a value of the scene; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("PATH=VALUE");
  CLI::Option* resume =
      run->add_option("--resume", call.run.checkpoint, "Checkpoint of the same scene to go on from")
          ->type_name("FILE");
  run->add_flag("--as-stage", call.run.as_stage,
                "Continue from the checkpoint as a new stage, with other loads, joint strengths or schedule")
      ->needs(resume);
  dda::expect_whole_number(
      run->add_option("--threads", call.run.threads,
                      "Threads that share the work on blocks, contacts and frames; results are the same for "
                      "any number"),
      1, 1024)
      ->capture_default_str();
  run->add_flag("--force", call.run.force, "Overwrite older results instead of renaming them");
  run->add_flag("--quiet", call.run.quiet, "Print problems only");

  CLI::App* check = app.add_subcommand("check", "Read and check scenes, compute nothing");
  check->add_option("SCENE", call.scenes_to_check, "Scene files (TOML)")->required();
  check->add_option("--set", call.check_settings, "Replace a value of the scenes; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("PATH=VALUE");
}

void declare(CLI::App& app, Call& call) {
  app.name("dda");
  app.formatter(dda::plain_help("VERB"));  // before the verbs, which inherit it
  app.set_version_flag("--version", POLYDDA_VERSION);
  app.require_subcommand(1);
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
  help->add_option(
      "TOPIC", call.help_words,
      "A table of the scene, units, files, statuses, schemes, completion, or a verb and its kind; "
      "left out: the list");
  app.add_subcommand("schema", "Print a JSON schema of the scene, for editors");
  for (CLI::App* verb : app.get_subcommands({})) verb->group("Verbs");
  app.footer(dda::help_footer());  // after the verbs, which would inherit it
  dda::expect_values(app);
}

int parse_and_execute(int argc, char** argv) {
  CLI::App app{"Discontinuous deformation analysis of blocks in contact"};
  Call call;
  declare(app, call);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answered) {
    std::ostringstream text;  // CLI11 flushes what it prints and does not look whether that failed
    const int status = app.exit(answered, text, text);
    fmt::print("{}", text.str());
    return status;
  } catch (const CLI::ParseError& error) {
    dda::print_error(dda::call_problem(app, error));
    return dda::wrong_input;
  }
  if (call.run.threads > 1) dda::spin_briefly(argv);
  return execute(app, call);
}

}  // namespace

/// Files must not be opened as a standard stream that is closed: what is told would go into them.
void keep_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

int main(int argc, char** argv) {
  keep_standard_streams();
  dda::keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // beyond a limit on the size of files writing fails, as on a full disk
  try {
    const int status = parse_and_execute(argc, argv);
    if (std::fflush(stdout) == 0 || status != dda::done) return status;
    dda::print_error(std::string("cannot write to stdout: ") + std::strerror(errno));
    return dda::file_error;
  } catch (const std::bad_alloc&) {
    dda::print_error("out of memory");
    return dda::analysis_stopped;
  } catch (const std::system_error& error) {  // of files, and of stdout
    dda::print_error(error.what());
    return dda::file_error;
  } catch (const std::exception& error) {
    dda::print_error(error.what());
    return dda::analysis_stopped;
  }
}
