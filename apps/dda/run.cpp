#include "run.hpp"

#include "call_error.hpp"
#include "checkpoints.hpp"
#include "exit_status.hpp"
#include "interruption.hpp"
#include "memory.hpp"
#include "messages.hpp"
#include "named_files.hpp"
#include "progress.hpp"
#include "run_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <ddacontact/output/older_results.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/result_directory.hpp>
#include <ddacontact/output/run_verdict.hpp>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/resumption.hpp>
#include <polyfem/assembly/blas.hpp>
#include <polyfem/core/parallel.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <chrono>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <new>

namespace dda {

using namespace ddacontact;
using Clock = std::chrono::steady_clock;

namespace {

std::filesystem::path default_directory(const std::string& scene) {
  std::filesystem::path path(scene);
  path.replace_extension();
  return path += "-out";
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& path, bool goes_on) {
  try {
    auto log = std::make_shared<spdlog::logger>(
        "dda", std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string(), !goes_on));
    log->set_pattern("%v");
    return log;
  } catch (const spdlog::spdlog_ex& error) {
    throw OutputError(error.what());
  }
}

/// What a run writes.
struct RunOutput {
  std::filesystem::path directory;
  ResultDirectory results;
  std::unique_ptr<DirectoryLock> lock;
  Checkpoints checkpoints;
  std::shared_ptr<spdlog::logger> log;
};

/// Steps until the end, a stop or a signal; fills the summary's status and reason.
void run_steps(Stepper& stepper, const std::optional<int>& steps,
               const std::vector<MonitorTarget>& monitor_targets, Progress& progress, RunOutput& output,
               RunSummary& summary) {
  {
    const polyfem::Stopwatch watch(summary.seconds_output);
    output.results.write_start(stepper, monitor_targets);
  }
  summary.status = "completed";
  while (!is_done(stepper, steps)) {
    bool stepped = false;
    if (!interruption()) {
      const polyfem::Stopwatch watch(summary.seconds_steps);
      stepped = stepper.step();
    }
    if (!stepped) {
      summary.status = interruption() ? "interrupted" : "stopped";
      summary.reason =
          interruption() ? fmt::format("interrupted by signal {}", interruption()) : stepper.stop_reason();
      break;
    }
    const polyfem::Stopwatch watch(summary.seconds_output);
    output.results.write_step(stepper, monitor_targets);
    output.checkpoints.write_if_due(stepper, output.results);
    progress.show(stepper);
  }
}

/// Everything that a run ends with: what can be written is, then the first failure is thrown. Where memory
/// does not suffice for results the run counts as stopped, unless there is no checkpoint either.
void write_end(const Stepper& stepper, RunOutput& output, RunSummary& summary, Clock::time_point start) {
  std::exception_ptr failure;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const OutputError&) {
      if (!failure) failure = std::current_exception();
    } catch (const std::bad_alloc&) {
      summary.status = "stopped";
      summary.reason = "out of memory while results were written";
      return false;
    }
    return true;
  };
  {
    const polyfem::Stopwatch watch(summary.seconds_output);
    if (!attempt([&] { output.checkpoints.write(stepper, output.results); })) throw std::bad_alloc();
    attempt([&] { output.results.write_last_frame(stepper); });
  }
  summary.warnings = warnings_of(stepper, output.results.labels().block_reasons);
  summary.scheme = scheme_word(stepper);
  summary.peak_memory_mb = peak_memory_mb();
  summary.seconds_total = seconds_since(start);
  attempt([&] { output.results.finish(stepper, summary); });
  if (failure) std::rethrow_exception(failure);
}

int finish(const RunArguments& arguments, const Stepper& stepper, const RunSummary& summary,
           const RunOutput& output) {
  spdlog::logger& log = *output.log;
  const StepCounts& counts = stepper.counts();
  const std::string outcome = fmt::format(
      "{}: {} steps, time {:.6g} s, {} substeps, {} rejected, {} unconverged, {} contact iterations, {} "
      "contacts",
      summary.status, counts.steps, stepper.state().time, counts.substeps, counts.rejected,
      counts.unconverged, counts.contact_iterations, counts.contacts);
  log.info("{}", outcome);
  log.info(
      "{} interior-point solves, {} augmentations, {} broken bonds, {} impacts ({} limited, {} "
      "unsettled), largest "
      "residual {:.2g} of the forces",
      counts.interior_point_solves, counts.augmentations, counts.broken_bonds, counts.impacts,
      counts.limited_impacts, counts.unsettled_impacts, counts.max_residual);
  if (!summary.reason.empty()) log.info("reason: {}", summary.reason);
  for (const std::string& note : stepper.notes()) {
    log.warn("{}", note);
    if (!arguments.quiet) say("{}: note: {}\n", arguments.scene, note);
  }
  if (counts.unconverged > 0) {
    const std::string warning = fmt::format("{} of {} substeps were accepted unsettled: {}",
                                            counts.unconverged, counts.substeps, stepper.last_unsettled());
    log.warn("{}", warning);
    say("{}: warning: {}\n", arguments.scene, warning);
  }
  for (const std::string& warning : summary.warnings) {
    log.warn("{}", warning);
    say("{}: warning: {}\n", arguments.scene, warning);
  }
  log.flush();
  if (!arguments.quiet) fmt::print("{}\nresults in {}\n", outcome, output.directory.string());
  if (summary.status == "completed") return done;
  print_error(fmt::format("{} at time {:.6g} s: {}", summary.status, stepper.state().time, summary.reason));
  return summary.status == "stopped" ? static_cast<int>(analysis_stopped) : interrupted + interruption();
}

/// A line for each model that "auto" chose, by reason.
void log_choices(const Labels& labels, spdlog::logger& log) {
  struct Blocks {
    std::size_t count = 0, first = 0;
  };
  std::map<std::pair<std::string, std::string>, Blocks> chosen;
  for (std::size_t b = 0; b < labels.block_names.size(); ++b) {
    if (labels.block_reasons[b].empty()) continue;
    Blocks& blocks = chosen[{labels.block_models[b], labels.block_reasons[b]}];
    if (blocks.count++ == 0) blocks.first = b;
  }
  for (const auto& [choice, blocks] : chosen)
    log.info("auto: {} for \"{}\"{}: {}", choice.first, labels.block_names[blocks.first],
             blocks.count > 1 ? fmt::format(" and {} more", blocks.count - 1) : "", choice.second);
}

/// Older results that the run does not write on to are renamed; says where they are. A new stage goes on in a
/// directory of its own.
/// \param[in,out] checkpoint  of the arguments; moves with its directory
void keep_older(const RunArguments& arguments, const std::filesystem::path& directory,
                std::string& checkpoint) {
  DirectoryLock::expect_free(directory);
  const std::vector<std::filesystem::path> files = files_of_scene(arguments.scene, arguments.settings);
  if (arguments.force) {
    if (checkpoint.empty() || arguments.as_stage) expect_none_overwritten(directory, files);
    return;
  }
  bool is_beside = false;
  if (!checkpoint.empty()) {
    const std::filesystem::path beside = std::filesystem::canonical(checkpoint).parent_path();
    std::error_code missing;
    is_beside = std::filesystem::equivalent(beside, directory, missing);
    const bool goes_on = !std::filesystem::exists(beside / "energy.csv", missing) || is_beside;
    if (goes_on && !arguments.as_stage) return;
  }
  if (holds_results(directory)) {
    expect_none_in(directory, files);
  } else {
    expect_none_overwritten(directory, files);
    expect_no_others_files(directory);
  }
  const auto kept = keep_older_results(directory);
  if (!kept) return;
  if (is_beside) checkpoint = (*kept / std::filesystem::path(checkpoint).filename()).string();
  if (!arguments.quiet) say("{}: note: older results are in {} now\n", arguments.scene, kept->string());
}

/// A new result directory, or one that goes on with the histories beside a checkpoint, or with its own where
/// there are none beside it.
ResultDirectory open_results(const std::string& checkpoint, const std::filesystem::path& directory,
                             const Labels& labels, const FrameOptions& frames,
                             const std::optional<Checkpoint>& from) {
  std::error_code missing;
  if (!from) {
    std::filesystem::remove(directory / checkpoint_file, missing);  // of another run
    return {directory, labels, frames};
  }
  const std::filesystem::path beside = std::filesystem::canonical(checkpoint).parent_path();
  const bool has_histories = std::filesystem::exists(beside / "energy.csv", missing);
  return {directory, labels, frames, has_histories ? beside : directory, from->marks};
}

/// Reads the checkpoint that the scene goes on from, as whose next stage it may come; nothing when it does
/// not belong to it, which is printed.
std::optional<Checkpoint> checkpoint_of(const RunArguments& arguments, Scene& scene) {
  Checkpoint from = read_checkpoint(arguments.checkpoint);
  std::optional<Problem> problem;
  if (arguments.as_stage) {
    std::variant<Scene, Problem> going_on =
        scene_as_stage(from, arguments.checkpoint, scene, arguments.scene);
    if (const auto* wrong = std::get_if<Problem>(&going_on))
      problem = *wrong;
    else
      scene = std::get<Scene>(std::move(going_on));
    from.record.step.state.carried.setZero();  // it holds half of the impulse of loads that act no more
    from.record.step.state.carried_dt = 0;
  } else {
    problem = find_mismatch(from, arguments.checkpoint, scene, arguments.scene);
  }
  if (!problem) return from;
  say("{}\n", problem->text());
  return std::nullopt;
}

void add_notes_of_resumption(const RunArguments& arguments, const Checkpoint& from,
                             const ResultDirectory& results, const std::string& made_by,
                             std::vector<std::string>& notes) {
  if (const auto missing = results.missing_histories(); !missing.empty())
    notes.push_back(fmt::format("what was before step {} is not beside {}: {} begin there",
                                from.record.counts.steps, arguments.checkpoint, fmt::join(missing, ", ")));
  if (from.made_by != made_by)
    notes.push_back(
        fmt::format("{} was made by {}: last digits may differ", arguments.checkpoint, from.made_by));
}

/// Begins what a run writes, older results out of the way, with what it is told of the scene.
RunOutput open_output(const RunArguments& arguments, const Scene& scene, BuiltScene& built,
                      const std::optional<Checkpoint>& from, const std::string& blas) {
  const std::filesystem::path directory = arguments.directory.empty()
                                              ? default_directory(arguments.scene)
                                              : std::filesystem::path(arguments.directory);
  std::string checkpoint = arguments.checkpoint;
  keep_older(arguments, directory, checkpoint);
  const std::string made_by = fmt::format("dda {}, {}, {}", POLYDDA_VERSION, blas, __VERSION__);
  RunOutput output{
      directory,
      open_results(checkpoint, directory, built.labels, frame_options(scene, arguments.threads), from),
      std::make_unique<DirectoryLock>(directory),
      Checkpoints(scene, directory, scene.output.checkpoint_every, made_by),
      open_log(directory / "log.txt", from.has_value())};
  write_scene_file(directory / "scene.toml", scene);
  spdlog::logger& log = *output.log;
  log.info("dda {}, BLAS: {}", POLYDDA_VERSION, blas);
  log.info("{}: {} blocks, {} unknowns, {} steps of {} s", arguments.scene, scene.blocks.size(),
           built.stepper->blocks().n_equations(), arguments.steps.value_or(scene.n_steps()),
           scene.analysis.time_step);
  log_choices(built.labels, log);
  if (from) {
    log.info("resumed from {} after step {}", arguments.checkpoint, from->record.counts.steps);
    add_notes_of_resumption(arguments, *from, output.results, made_by, built.notes);
  }
  for (const std::string& note : built.notes) {
    log.warn("{}", note);
    if (!arguments.quiet) say("{}: note: {}\n", arguments.scene, note);
  }
  log.flush();
  return output;
}

int run_scene(const RunArguments& arguments, Scene& scene, Clock::time_point start) {
  std::optional<Checkpoint> from;
  if (!arguments.checkpoint.empty()) {
    from = checkpoint_of(arguments, scene);
    if (!from) return wrong_input;
  }
  const std::string blas = polyfem::pin_blas_to_one_thread();
  polyfem::set_threads(arguments.threads);
  BuiltScene built = build(scene);
  note_interruptions();  // before there is something to keep a signal ends the program at once
  built.stepper->interrupt_when([] { return interruption() != 0; });
  RunSummary summary;
  if (from) {
    built.stepper->restore(from->record);
    summary.resumed_after = from->record.counts.steps;
  }
  summary.domain = scene.domain;
  summary.seconds_setup = seconds_since(start);
  summary.versions = {{"program", POLYDDA_VERSION}, {"blas", blas}, {"compiler", __VERSION__}};
  RunOutput output = open_output(arguments, scene, built, from, blas);
  Progress progress(arguments.steps.value_or(scene.n_steps()), arguments.quiet);
  try {
    run_steps(*built.stepper, arguments.steps, built.monitor_targets, progress, output, summary);
    progress.finish();
    write_end(*built.stepper, output, summary, start);
  } catch (const OutputError& error) {
    output.log->error("{}", error.what());
    throw;
  }
  return finish(arguments, *built.stepper, summary, output);
}

}  // namespace

int run(const RunArguments& arguments) {
  const Clock::time_point start = Clock::now();
  SceneReading reading = read_scene(arguments.scene, arguments.settings, arguments.as_stage);
  if (const int status = report(reading); !reading.scene) return status;
  if (const auto problem = memory_problem(*reading.scene)) {
    say("{}:1:1: error: {}\n", arguments.scene, *problem);
    return wrong_input;
  }
  try {
    return run_scene(arguments, *reading.scene, start);
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const OutputError& error) {
    print_error(error.what());
    return file_error;
  } catch (const std::bad_alloc& error) {
    print_error(fmt::format(
        "out of memory with {} blocks ({}) after {:.0f} MB: the last steps are not in a checkpoint",
        reading.scene->blocks.size(), error.what(), peak_memory_mb()));
    return file_error;
  } catch (const Error& error) {
    say("{}:1:1: error: {}\n", arguments.scene, error.what());
    return wrong_input;
  }
}

}  // namespace dda
