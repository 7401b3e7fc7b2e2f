/// \file The files of a run.
#pragma once

#include <ddacontact/domain/domain_cutting.hpp>
#include <ddacontact/output/csv_file.hpp>
#include <ddacontact/output/frame_writer.hpp>
#include <ddacontact/output/labels.hpp>
#include <ddacontact/time/monitor_target.hpp>
#include <ddacontact/time/stepper.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// What the program knows of a run beside the stepper.
struct RunSummary {
  std::string status;      ///< "completed", "stopped", "interrupted"
  std::string reason;      ///< empty when completed
  std::string scheme;      ///< of the last stage that was entered
  long resumed_after = 0;  ///< the step of the checkpoint
  double seconds_total = 0, seconds_setup = 0, seconds_steps = 0, seconds_output = 0;
  double peak_memory_mb = 0;
  std::map<std::string, std::string> versions;
  std::vector<std::string> warnings;     ///< see warnings_of
  std::optional<DomainCounts> domain{};  ///< what cutting blocks from it came to
};

/// Histories are written while the run goes on, the rest at its
/// end. Everything throws OutputError on failure.
class ResultDirectory {
 public:
  /// Makes the directory and starts the histories and the frames.
  ResultDirectory(std::filesystem::path directory, Labels labels, const FrameOptions& frames = {});
  /// Goes on with the histories and frames of `source`, which may be the directory itself, as far as `marks`
  /// says; what is not there as it was begins anew, see missing_histories.
  ResultDirectory(std::filesystem::path directory, Labels labels, const FrameOptions& frames,
                  const std::filesystem::path& source, const ResultMarks& marks);

  /// The files that could not be gone on with.
  std::vector<std::string> missing_histories() const;
  /// Where the histories stand; they are in the files then.
  ResultMarks marks();

  /// write_step for the files that begin with the present state.
  void write_start(const Stepper& stepper, const std::vector<MonitorTarget>& monitor_targets);
  /// A row per monitor, bolt and supported block and one of energies, for the state as it is, and a frame
  /// when it is time.
  void write_step(const Stepper& stepper, const std::vector<MonitorTarget>& monitor_targets);
  /// The frame a run ends with, unless it is there already.
  void write_last_frame(const Stepper& stepper) { frames_.write_last(stepper, labels_); }
  /// blocks.csv, vertices.csv, contacts.csv, supports.csv, bolts.csv where there are bolts, and summary.json.
  void finish(const Stepper& stepper, const RunSummary& summary);

  const std::filesystem::path& path() const { return directory_; }
  const Labels& labels() const { return labels_; }

 private:
  void write_monitors(const Stepper& stepper, const std::vector<MonitorTarget>& monitor_targets);
  void write_energy(const Stepper& stepper);
  void write_bolt_history(const Stepper& stepper);
  void write_support_history(const Stepper& stepper);
  void write_blocks(const Stepper& stepper);
  void write_vertices(const Stepper& stepper);
  void write_contacts(const Stepper& stepper);
  void write_bolts(const Stepper& stepper);
  void write_supports(const Stepper& stepper);
  void write_summary(const Stepper& stepper, const RunSummary& summary);
  std::string file(const char* name) const { return (directory_ / name).string(); }

  std::filesystem::path directory_;
  Labels labels_;
  CsvFile energy_;  ///< the first file: it says that the directory is a run's (holds_results)
  CsvFile monitors_;
  std::optional<CsvFile> bolts_, supports_;  ///< of scenes with bolts, with supports
  FrameWriter frames_;
};

/// Makes the directory when it is not there, and returns it. Throws OutputError.
std::filesystem::path make_directory(std::filesystem::path directory);

}  // namespace ddacontact
