#include "info.hpp"

#include "answer.hpp"
#include "exit_status.hpp"
#include "info_result.hpp"
#include "info_run.hpp"
#include "messages.hpp"
#include "result.hpp"

#include <algorithm>
#include <functional>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

/// A part that cannot be told is a problem of its own: the others are told all the same.
int tell(Answer& answer, const std::function<void()>& part) {
  try {
    part();
    return done;
  } catch (const Error& error) {
    answer.line("not known");
    print_error(error.what());
    return file_error;
  }
}

}  // namespace

int info(const std::string& name) {
  try {
    const fs::path directory(name);
    expect_result_directory(directory);
    if (!fs::exists(directory / "summary.json")) {
      const fs::path checkpoint = directory / "checkpoint.bin";
      throw Error(fmt::format(
          "\"{}\" has no summary.json yet: its run is still going on, or was killed ({}run the scene again)",
          directory.string(),
          fs::exists(checkpoint) ? fmt::format("go on with --resume {}, or ", checkpoint.string()) : ""));
    }
    const SummaryTable summary = read_summary(directory / "summary.json");
    const std::optional<Scene> scene = scene_of(directory);
    Answer answer;
    answer.heading(title_of(directory, scene));
    tell_outcome(answer, summary);
    tell_rest(answer, summary);
    tell_warnings(answer, summary);
    tell_size(answer, summary);
    int status = tell(answer, [&] { tell_models(answer, directory); });
    tell_work(answer, summary);
    tell_impacts(answer, summary);
    status = std::max(status, tell(answer, [&] { tell_motion(answer, directory); }));
    status = std::max(status, tell(answer, [&] { tell_stress(answer, directory); }));
    status = std::max(status, tell(answer, [&] { tell_contacts(answer, summary, directory); }));
    tell_energy(answer, summary);
    status = std::max(status, tell(answer, [&] { tell_reactions(answer, scene, directory); }));
    tell_times(answer, summary);
    status = std::max(status, tell(answer, [&] { tell_frames(answer, directory); }));
    tell_files(answer, directory);
    fmt::print("{}", answer.text());
    return status;
  } catch (const Error& error) {
    print_error(error.what());
    return file_error;
  }
}

}  // namespace dda
