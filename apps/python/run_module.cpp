#include "module.hpp"

#include <pybind11/stl.h>
#include <apps/dda/checkpoints.hpp>
#include <apps/dda/memory.hpp>
#include <apps/dda/run_output.hpp>
#include <ddacontact/output/older_results.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/run_verdict.hpp>
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/reader.hpp>
#include <polyfem/assembly/blas.hpp>
#include <polyfem/core/parallel.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace polydda_python {

namespace py = pybind11;
using namespace ddacontact;

namespace {

/// A problem as (severity, file, line, column, what, cure, text).
py::tuple tuple_of(const Problem& problem) {
  const bool error = problem.severity == Problem::Severity::error;
  return py::make_tuple(error ? "error" : "warning", problem.file, problem.line, problem.column, problem.what,
                        problem.cure, problem.text());
}

py::list list_of(const std::vector<Problem>& problems) {
  py::list list;
  for (const Problem& problem : problems) list.append(tuple_of(problem));
  return list;
}

SceneReading read(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                  const std::string& directory) {
  const py::gil_scoped_release release;
  SceneReading reading = read_scene_text(text, name, settings, directory);
  if (reading.scene)
    if (const auto problem = dda::memory_problem(*reading.scene)) {
      reading.problems.push_back({.file = name, .what = *problem, .cure = ""});
      reading.scene.reset();
    }
  return reading;
}

/// Before a run has results there is nothing to keep: it ends by this, and the listener has the reason.
struct Interrupted {};

/// Python's side of a run: Ctrl-C and `on_step`, either of which may leave an exception behind.
class Listener {
 public:
  explicit Listener(py::object on_step) : on_step_(std::move(on_step)) {}

  /// Whether the run is to end: looks for signals, as Python does between two of its own statements.
  bool interrupted() {
    if (exception_) return true;
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) exception_.emplace();
    return exception_.has_value();
  }
  void stepped(const Stepper& stepper, int n_steps) {
    if (on_step_.is_none()) return;
    const py::gil_scoped_acquire acquire;
    try {
      on_step_(stepper.counts().steps, n_steps, stepper.state().time);
    } catch (py::error_already_set& error) {
      exception_.emplace(error);
    }
  }
  /// Ends the set-up where the run is to end.
  void end_if_interrupted() {
    if (interrupted()) throw Interrupted();
  }
  void rethrow() {
    if (exception_) throw py::error_already_set(*exception_);
  }

 private:
  py::object on_step_;
  std::optional<py::error_already_set> exception_;
};

/// Notes and warnings of a run.
struct Remarks {
  std::vector<std::string> notes, warnings;
};

/// Runs a checked scene as `dda run` does.
Remarks run_to_end(const Scene& scene, const std::string& directory, int threads, bool force,
                   Listener& listener) {
  RunSummary summary;
  dda::keep_freed_memory();
  const std::string blas = polyfem::pin_blas_to_one_thread();
  polyfem::set_threads(threads);
  std::optional<polyfem::Stopwatch> total(summary.seconds_total), setup(summary.seconds_setup);
  BuiltScene built = build(scene, [&] { listener.end_if_interrupted(); });
  Stepper& stepper = *built.stepper;
  stepper.interrupt_when([&] { return listener.interrupted(); });
  setup.reset();
  summary.domain = scene.domain;
  summary.versions = {{"program", POLYDDA_VERSION}, {"blas", blas}, {"compiler", __VERSION__}};
  DirectoryLock::expect_free(directory);
  if (!force) {
    expect_no_others_files(directory);
    keep_older_results(directory);
  }
  ResultDirectory results(directory, built.labels, dda::frame_options(scene, threads));
  const DirectoryLock lock(directory);
  dda::Checkpoints checkpoints(scene, directory, scene.output.checkpoint_every,
                               std::string("dda ") + POLYDDA_VERSION + ", " + blas + ", " + __VERSION__);
  dda::write_scene_file(results.path() / "scene.toml", scene);
  results.write_start(stepper, built.monitor_targets);
  summary.status = "completed";
  while (!dda::is_done(stepper)) {
    bool stepped = false;
    if (!listener.interrupted()) {
      const polyfem::Stopwatch watch(summary.seconds_steps);
      stepped = stepper.step();
    }
    if (!stepped) {
      summary.status = listener.interrupted() ? "interrupted" : "stopped";
      summary.reason = listener.interrupted() ? "interrupted from Python" : stepper.stop_reason();
      break;
    }
    const polyfem::Stopwatch watch(summary.seconds_output);
    results.write_step(stepper, built.monitor_targets);
    checkpoints.write_if_due(stepper, results);
    listener.stepped(stepper, scene.n_steps());
  }
  checkpoints.write(stepper, results);
  results.write_last_frame(stepper);
  summary.warnings = warnings_of(stepper, results.labels().block_reasons);
  summary.scheme = dda::scheme_word(stepper);
  summary.peak_memory_mb = dda::peak_memory_mb();
  total.reset();
  results.finish(stepper, summary);
  Remarks remarks{built.notes, summary.warnings};
  remarks.notes.insert(remarks.notes.end(), stepper.notes().begin(), stepper.notes().end());
  return remarks;
}

py::list check_text(const std::string& text, const std::string& name,
                    const std::vector<std::string>& settings, const std::string& directory) {
  SceneReading reading = read(text, name, settings, directory);
  if (reading.scene) {
    try {
      const py::gil_scoped_release release;
      build(*reading.scene);
    } catch (const Error& error) {
      reading.problems.push_back({.file = name, .what = error.what(), .cure = ""});
    }
  }
  return list_of(reading.problems);
}

/// The text of a scene, its name, settings and the directory that its files are relative to.
using SceneSource = std::tuple<std::string, std::string, std::vector<std::string>, std::string>;

py::tuple run_text(const SceneSource& source, const std::string& results, int threads, bool force,
                   const py::object& on_step) {
  const auto& [text, name, settings, directory] = source;
  SceneReading reading = read(text, name, settings, directory);
  Remarks remarks;
  if (reading.scene) {
    Listener listener(on_step);
    try {
      const py::gil_scoped_release release;
      remarks = run_to_end(*reading.scene, results, threads, force, listener);
    } catch (const Interrupted&) {
    }
    listener.rethrow();
  }
  return py::make_tuple(reading.scene.has_value(), list_of(reading.problems), remarks.notes,
                        remarks.warnings);
}

}  // namespace

void add_running(py::module_& module) {
  module.def("check_text", &check_text, py::arg("text"), py::arg("name"), py::arg("settings"),
             py::arg("directory"),
             "The problems of a scene text: (severity, file, line, column, what, cure, text).");
  module.def(
      "run_text", &run_text, py::arg("source"), py::arg("results"), py::arg("threads"), py::arg("force"),
      py::arg("on_step"),
      "Runs a scene given as (text, name, settings, directory): (whether it was a scene, its problems, "
      "notes, warnings).");
}

}  // namespace polydda_python
