#include <tests/performance/error_time/measurement.hpp>

#include <mechanics_scenes.hpp>
#include <polyfem/core/error.hpp>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace error_time {

using namespace verification;

namespace {

constexpr double longest_run = 15, longest_repeated = 2, long_enough = 0.15;  // s
constexpr std::size_t repetitions = 3, most_repetitions = 9;

struct Run {
  BuiltScene built;
  double seconds = 0;
  std::string stopped;
};

Run run_once(const Scene& scene, bool settles) {
  Run made{build(scene), 0, ""};
  Stepper& stepper = *made.built.stepper;
  const int untimed = settles ? scene.stages[0].analysis.steps : 0;
  run(stepper, untimed);
  const double start = processor_time();
  for (int k = untimed; k < scene.n_steps() && made.stopped.empty(); ++k) {
    if (!stepper.step()) made.stopped = stepper.stop_reason();
    if (processor_time() - start > longest_run) made.stopped = "takes too long";
  }
  made.seconds = processor_time() - start;
  return made;
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == '\n'; }, ';');
  return text;
}

constexpr const char* header =
    "problem,quantity,method,setting,seconds,error,steps,substeps,rejected,solutions,stopped";

}  // namespace

std::vector<Measurement> measure(const Problem& problem, const Judge& judge, const Method& method,
                                 double setting, bool repeat) {
  Measurement of_run{.problem = problem.name, .quantity = {}, .method = method.name, .setting = setting};
  std::vector<Measurement> found;
  std::vector<double> errors(problem.quantities.size(), of_run.error);
  try {
    const Scene scene = problem.scene(method, setting);
    const Run first = run_once(scene, problem.settles);
    std::vector<double> seconds{first.seconds};
    double sum = first.seconds;
    while (repeat && first.seconds < longest_repeated &&
           (seconds.size() < repetitions || (sum < long_enough && seconds.size() < most_repetitions))) {
      seconds.push_back(run_once(scene, problem.settles).seconds);
      sum += seconds.back();
    }
    std::ranges::nth_element(seconds, seconds.begin() + static_cast<long>(seconds.size() / 2));
    of_run.seconds = seconds[seconds.size() / 2];
    of_run.stopped = one_line(first.stopped);
    const StepCounts& counts = first.built.stepper->counts();
    of_run.steps = counts.steps;
    of_run.substeps = counts.substeps;
    of_run.rejected = counts.rejected;
    of_run.solutions = counts.contact_iterations;
    if (first.stopped.empty()) errors = judge(*first.built.stepper);
  } catch (const Error& error) {
    of_run.stopped = one_line(error.what());
  }
  for (std::size_t k = 0; k < errors.size(); ++k) {
    of_run.quantity = problem.quantities[k].name;
    of_run.error = errors[k];
    found.push_back(of_run);
  }
  return found;
}

std::vector<Measurement> measure_all(const std::string& only,
                                     const std::function<void(const Measurement&)>& tell) {
  std::vector<Measurement> all;
  for (const Problem& problem : all_problems()) {
    if (!only.empty() && problem.name != only) continue;
    const Judge judge = problem.judge();
    for (const Method& method : all_methods()) {
      if (problem.is_static && method.scheme != (method.paper ? Scheme::dda : Scheme::decaying)) continue;
      double seconds = 0;
      for (const double setting : problem.settings) {
        if (seconds > longest_repeated) break;
        for (const Measurement& m : measure(problem, judge, method, setting)) {
          all.push_back(m);
          seconds = m.seconds;
          tell(m);
        }
      }
    }
  }
  return all;
}

void write_table(const std::filesystem::path& path, const std::vector<Measurement>& measurements) {
  std::ofstream file(path);
  file << header << '\n' << std::setprecision(5);
  for (const Measurement& m : measurements)
    file << m.problem << ',' << m.quantity << ',' << m.method << ',' << m.setting << ',' << m.seconds << ','
         << m.error << ',' << m.steps << ',' << m.substeps << ',' << m.rejected << ',' << m.solutions << ','
         << m.stopped << '\n';
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

std::vector<Measurement> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header)
    throw polyfem::Error("\"" + path.string() + "\" is no table of measurements");
  std::vector<Measurement> measurements;
  while (std::getline(file, line)) {
    std::vector<std::string> f;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) f.push_back(field);
    if (f.size() == 10) f.emplace_back();
    if (f.size() != 11) throw polyfem::Error("\"" + path.string() + "\" has a line that is cut off: " + line);
    measurements.push_back({f[0], f[1], f[2], std::stod(f[3]), std::stod(f[4]), std::stod(f[5]),
                            std::stol(f[6]), std::stol(f[7]), std::stol(f[8]), std::stol(f[9]), f[10]});
  }
  return measurements;
}

}  // namespace error_time
