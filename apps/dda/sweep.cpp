#include "sweep.hpp"

#include "call_error.hpp"
#include "checkpoints.hpp"
#include "exit_status.hpp"
#include "interruption.hpp"
#include "messages.hpp"
#include "named_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <ddacontact/output/csv_file.hpp>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/older_results.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/whole_file.hpp>
#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/study/factor_distribution.hpp>
#include <ddacontact/study/job_queue.hpp>
#include <ddacontact/study/safety_files.hpp>
#include <ddacontact/study/sweep_cases.hpp>
#include <ddacontact/study/sweep_map.hpp>
#include <ddacontact/study/sweep_results.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <thread>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

void write(const fs::path& path, const std::string& text) {
  write_whole(path, [&](std::ostream& out) { out << text; });
}

/// For a shell.
std::string in_quotes(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

class Sweep {
 public:
  explicit Sweep(const SweepArguments& arguments) : arguments_(arguments), directory_(arguments.directory) {
    std::vector<Variation> variations;
    for (const std::string& text : arguments.vary) variations.push_back(parse_variation(text));
    cases_ = sweep_cases(variations, arguments.table);
    if (arguments.safety) outcomes_ = outcomes_of_safety();
    for (const std::string& text : arguments.outcomes) outcomes_.push_back(parse_outcome(text));
    if (arguments.only > n_cases())
      throw Error(fmt::format("--case {}: there are {} cases", arguments.only, n_cases()));
    check_settings();
    check_names();
    scene_text_ = text_of(arguments.scene);
    scene_text_ += files_named_by(quoted_words(scene_text_));
  }

  /// Throws Error where no case is a scene, as with a path that is not there: nothing is written then.
  void expect_a_scene() const {
    std::string first;
    for (int i = 0, n_tried = std::min(n_cases(), most_tried); i < n_tried; ++i) {
      const auto k = static_cast<int>(static_cast<long>(n_cases()) * i / n_tried) + 1;
      const SceneReading reading = read_scene(arguments_.scene, settings_of(k));
      if (reading.scene) return;
      const auto error = std::ranges::find(reading.problems, Problem::Severity::error, &Problem::severity);
      if (first.empty() && error != reading.problems.end()) first = error->text();
    }
    throw Error("no case could be run: " + first);
  }

  /// Throws CallError where a case's older results hold what the sweep reads: they are renamed.
  void expect_sources_elsewhere() const {
    std::error_code error;
    for (int k = 1; k <= n_cases(); ++k) {
      if (!fs::exists(path_of(k), error)) continue;
      std::vector<fs::path> files = files_of_scene(arguments_.scene, settings_of(k));
      files.emplace_back(arguments_.table);
      expect_none_in(path_of(k), files);
    }
  }

  void make_directory() const {
    std::error_code error;
    fs::create_directories(directory_, error);
    if (error) throw OutputError(fmt::format("cannot make \"{}\": {}", directory_.string(), error.message()));
  }

  int n_cases() const { return static_cast<int>(cases_.rows.size()); }

  /// Of the cases, or of the only one.
  std::vector<int> unfinished() const {
    std::vector<int> cases;
    for (int k = 1; k <= n_cases(); ++k)
      if ((arguments_.only == 0 || arguments_.only == k) && !is_finished(k)) cases.push_back(k);
    return cases;
  }

  /// The cases that are not finished, `jobs` at a time.
  void run() {
    const std::vector<int> waiting = unfinished();
    if (!arguments_.quiet) say("{} of {} cases to run\n", waiting.size(), n_cases());
    std::map<pid_t, int> running;
    const auto wait_one = [&] {
      int status = 0;
      auto ended = running.end();
      while (!running.empty() && ended == running.end()) {
        // Ctrl-C reaches them too; a second one would not let them write their checkpoints.
        if (interruption())
          for (const auto& [child, k] : running) kill(child, SIGTERM);
        ended = running.find(waitpid(-1, &status, 0));
      }
      if (ended == running.end()) return;
      note_end(ended->second, status);
      tell(ended->second);
      running.erase(ended);
    };
    note_interruptions(0);
    run_jobs(
        waiting, n_jobs(),
        [&](int k) {
          if (!interruption()) running[start(k)] = k;
        },
        wait_one);
  }

  /// Of sweep.csv.
  std::vector<std::string> columns() const {
    std::vector<std::string> names{"case"};
    names.insert(names.end(), cases_.paths.begin(), cases_.paths.end());
    names.insert(names.end(),
                 {"status", "steps_completed", "time", "max_displacement", "kinetic", "wall_seconds"});
    for (const Outcome& outcome : outcomes_) names.push_back(outcome.name);
    names.emplace_back("reason");
    return names;
  }

  /// Throws Error where it is no column of sweep.csv.
  void check_column(const std::string& name) const {
    const std::vector<std::string> names = columns();
    if (std::ranges::count(names, name) == 0)
      throw Error(fmt::format("sweep.csv will have no column \"{}\" ({})", name,
                              choice_among(name, {names.begin(), names.end()})));
  }

  /// Whether any case has a result.
  /// \param[out] reason  why the first case that failed did so
  bool write_table(std::string& reason) const {
    const fs::path table = directory_ / "sweep.csv", fresh = directory_ / "sweep.csv.new";
    CsvFile csv(fresh.string(), fmt::format("{}", fmt::join(columns(), ",")));
    bool any = false;
    int n_warned = 0, first_warned = 0;
    std::vector<bool> known(outcomes_.size());
    for (int k = 1; k <= n_cases(); ++k) {
      const CaseResult r = read_case(path_of(k), outcomes_, log_of(k));
      any = any || r.status != "failed";
      if (r.status == "failed" && reason.empty()) reason = r.reason;
      csv.row(k, cases_.rows[k - 1], r.status, r.steps_completed, r.time, r.max_displacement, r.kinetic,
              r.wall_seconds, r.outcomes, r.reason);
      if (has_outcome(path_of(k), {"", "warnings.0"}) && ++n_warned == 1) first_warned = k;
      for (std::size_t i = 0; i < known.size(); ++i)
        known[i] = known[i] || !r.outcomes[i].empty() || has_outcome(path_of(k), outcomes_[i]);
    }
    csv.close();
    if (const auto kept = keep_older_file(table, text_of(fresh)); kept && !arguments_.quiet)
      say("dda: note: the older sweep.csv is {} now\n", kept->string());
    fs::rename(fresh, table);
    if (n_warned > 0)
      say("dda: warning: {} of {} cases warn of their results, the first in {}\n", n_warned, n_cases(),
          log_of(first_warned).string());
    for (std::size_t i = 0; i < known.size(); ++i)
      if (any && !known[i])
        say("dda: warning: outcome \"{}\" is empty: no result has \"{}\"\n", outcomes_[i].name,
            outcomes_[i].path);
    return any;
  }

  /// The same call as a job array, a job a case.
  void write_slurm() const {
    std::string call = "dda sweep " + in_quotes(fs::absolute(arguments_.scene).string());
    for (const std::string& vary : arguments_.vary) call += " --vary " + in_quotes(vary);
    if (!arguments_.table.empty()) call += " --table " + in_quotes(fs::absolute(arguments_.table).string());
    for (const std::string& setting : arguments_.settings) call += " --set " + in_quotes(setting);
    if (arguments_.safety) call += " --safety";
    for (const std::string& word : arguments_.of_safety()) call += ' ' + in_quotes(word);
    call += " -o " + in_quotes(fs::absolute(directory_).string());
    write(
        directory_ / "sweep.sbatch",
        fmt::format(
            "#!/bin/sh\n#SBATCH --job-name=dda-sweep\n#SBATCH --array=1-{}\n#SBATCH --ntasks=1\n"
            "#SBATCH --cpus-per-task=1\n# When all are done, the same call without --case writes sweep.csv.\n"
            "exec {} --quiet --case \"$SLURM_ARRAY_TASK_ID\"\n",
            n_cases(), call));
  }

 private:
  /// Scenes are read in so many cases at most, spread over all, to find one that can be run.
  static constexpr int most_tried = 100;

  /// A value is set or varied.
  void check_settings() const {
    for (const std::string& setting : arguments_.settings)
      if (const auto path = setting.substr(0, setting.find('=')); std::ranges::count(cases_.paths, path))
        throw Error(fmt::format("'{}' is set and varied (leave out --set {})", path, setting));
  }
  /// A name is of one column.
  void check_names() const {
    const std::vector<std::string> names = columns();
    for (const Outcome& outcome : outcomes_)
      if (std::ranges::count(names, outcome.name) > 1)
        throw Error(
            fmt::format("sweep.csv has a column \"{0}\" besides that of --outcome {0}={1} (write "
                        "another name)",
                        outcome.name, outcome.path));
  }

  static std::size_t n_processors() { return std::max(1u, std::thread::hardware_concurrency()); }
  /// Cases at a time.
  std::size_t n_jobs() const {
    return arguments_.jobs > 0 ? static_cast<std::size_t>(arguments_.jobs) : n_processors();
  }
  fs::path path_of(int k) const { return directory_ / fmt::format("case-{}", k); }
  fs::path log_of(int k) const { return directory_ / fmt::format("case-{}.log", k); }
  fs::path key_file_of(int k) const { return directory_ / fmt::format("case-{}.txt", k); }

  std::vector<std::string> settings_of(int k) const {
    std::vector<std::string> settings = arguments_.settings;
    for (const std::string& setting : cases_.settings(static_cast<std::size_t>(k - 1)))
      settings.push_back(setting);
    return settings;
  }
  std::string files_named_by(const std::vector<std::string>& words) const {
    return texts_of_files(fs::path(arguments_.scene).parent_path(), words);
  }
  /// What a result must have been made of to be that of the case.
  std::string key_of(int k) const {
    std::vector<std::string> values = settings_of(k);
    for (std::string& value : values) value.erase(0, value.find('=') + 1);
    const std::string safety =
        arguments_.safety ? fmt::format("safety {}\n", fmt::join(arguments_.of_safety(), " ")) : "";
    return fmt::format("{}\nscene {:016x}\n{}", fmt::join(settings_of(k), "\n"),
                       std::hash<std::string>()(scene_text_ + files_named_by(values)), safety);
  }
  bool is_of_this_case(int k) const { return text_of(key_file_of(k)) == key_of(k); }
  bool is_finished(int k) const {
    const std::string status = is_of_this_case(k) ? case_status(path_of(k)) : "";
    return status == "completed" || status == "stopped";
  }

  pid_t start(int k) const {
    std::error_code error;
    std::vector<std::string> words{"dda", "run", arguments_.scene, "-o", path_of(k).string(), "--quiet"};
    if (arguments_.safety) {
      words[1] = "safety";
      for (const std::string& word : arguments_.of_safety()) words.push_back(word);
      words.insert(words.end(),
                   {"--jobs", std::to_string(std::max<std::size_t>(1, n_processors() / n_jobs()))});
    } else {
      words.emplace_back("--force");
    }
    for (const std::string& setting : settings_of(k)) words.insert(words.end(), {"--set", setting});
    const fs::path checkpoint = path_of(k) / checkpoint_file;
    if (is_of_this_case(k) && case_status(path_of(k)) == "interrupted" && fs::exists(checkpoint, error)) {
      words.insert(words.end(), {"--resume", checkpoint.string()});
    } else {
      keep_older_results(path_of(k));
      fs::remove_all(path_of(k), error);
      write(key_file_of(k), key_of(k));
    }
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string log = log_of(k).string();
    const pid_t sweep = getpid(), child = fork();
    if (child < 0) throw OutputError(fmt::format("cannot start a case: {}", std::strerror(errno)));
    if (child > 0) return child;
    // However the sweep ends, its cases end with it, and leave a checkpoint.
    prctl(PR_SET_PDEATHSIG, SIGINT);
    end_at_interruptions();
    if (interruption()) _exit(file_error);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (getppid() == sweep && file >= 0 && dup2(file, STDERR_FILENO) >= 0 && dup2(file, STDOUT_FILENO) >= 0)
      execv("/proc/self/exe", argv.data());
    _exit(file_error);
  }

  /// Puts into the first line of its log how a case ended that could not say it itself.
  void note_end(int k, int status) const {
    const std::string log = text_of(log_of(k));
    const bool by_signal = WIFSIGNALED(status);
    if (!by_signal && (status == 0 || !log.empty())) return;
    const std::string end =
        by_signal ? fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
                  : fmt::format("ended with status {}", WEXITSTATUS(status));
    std::ofstream(log_of(k), std::ios::binary) << end << '\n' << log;
  }

  void tell(int k) const {
    const CaseResult result = read_case(path_of(k), {}, log_of(k));
    if (arguments_.quiet && result.status != "failed") return;
    say("case {}: {}{}{}\n", k, result.status, result.reason.empty() ? "" : ": ", result.reason);
  }

  const SweepArguments& arguments_;
  fs::path directory_;
  SweepCases cases_;
  std::vector<Outcome> outcomes_;
  std::string scene_text_;  ///< with the files that it names
};

void tell_factors(const fs::path& directory, bool quiet) {
  const CsvTable table(directory / "sweep.csv");
  const FactorDistribution found = distribution_of(table.texts("factor_low"), table.texts("factor_high"));
  if (!found.factors.empty()) write(directory / "factors.svg", draw(found));
  if (!quiet) fmt::print("{}", describe(found));
  if (const auto n = std::ranges::count(table.texts("rounded_corners"), word_of(Verdict::moves)); n > 0)
    say("dda: warning: in {} of these cases rounded corners move at 95 % of the factor: sharp ones "
        "interlock at steps that rock would not have (--set contact.corner_rounding=0.003)\n",
        n);
}

int sweep_all(const SweepArguments& arguments) {
  const std::optional<std::pair<std::string, std::string>> curve = arguments.curve_columns();
  std::optional<MapColumns> map;
  if (!arguments.map.empty()) map = parse_map(arguments.map);
  Sweep sweep(arguments);
  if (curve)
    for (const std::string& column : {curve->first, curve->second}) sweep.check_column(column);
  if (map)
    for (const std::string& column : {map->x, map->y, map->value}) sweep.check_column(column);
  sweep.expect_a_scene();
  sweep.expect_sources_elsewhere();
  sweep.make_directory();
  if (arguments.slurm) {
    sweep.write_slurm();
    if (!arguments.quiet)
      fmt::print("{} cases: sbatch {}/sweep.sbatch\n", sweep.n_cases(), arguments.directory);
    return done;
  }
  sweep.run();
  if (const std::size_t left = interruption() ? sweep.unfinished().size() : 0; left > 0) {
    print_error(
        fmt::format("interrupted by signal {}: {} of {} cases are left (the same call goes on with them)",
                    interruption(), left, sweep.n_cases()));
    return interrupted + interruption();
  }
  if (arguments.only > 0) return done;
  std::string reason;
  const bool any = sweep.write_table(reason);
  if (!any) {
    print_error(fmt::format("no case could be run: {} (all in {}/sweep.csv)", reason, arguments.directory));
    return wrong_input;
  }
  const fs::path directory(arguments.directory);
  if (curve) write(directory / "sweep.svg", curve_of(directory / "sweep.csv", curve->first, curve->second));
  if (map) write(directory / "map.svg", map_of(directory / "sweep.csv", *map));
  if (arguments.safety) tell_factors(directory, arguments.quiet);
  if (!arguments.quiet) fmt::print("{} cases in {}/sweep.csv\n", sweep.n_cases(), arguments.directory);
  return done;
}

}  // namespace

int sweep(const SweepArguments& arguments) {
  using scene_format::read_text;
  // Before the directory is made and a case is started; whether the scene is right depends on the case.
  if (!read_text(arguments.scene).text) return report(read_scene(arguments.scene));
  try {
    if (const auto& table = arguments.table; !table.empty() && !read_text(table).text)
      throw OutputError(fmt::format("cannot read \"{}\": {}", table, read_text(table).reason));
    return sweep_all(arguments);
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const OutputError& error) {
    print_error(error.what());
    return file_error;
  } catch (const Error& error) {
    print_error(error.what());
    return wrong_input;
  }
}

}  // namespace dda
