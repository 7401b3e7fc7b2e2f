#include "check.hpp"

#include "exit_status.hpp"
#include "memory.hpp"
#include "messages.hpp"

#include <fmt/format.h>
#include <ddacontact/scene/builder.hpp>

#include <algorithm>

namespace dda {

namespace {

int check_one(const std::string& path, const std::vector<std::string>& settings) {
  const ddacontact::SceneReading reading = ddacontact::read_scene(path, settings);
  const int status = report(reading);
  if (!reading.scene) return status;
  if (const auto problem = memory_problem(*reading.scene)) {
    say("{}:1:1: error: {}\n", path, *problem);
    return wrong_input;
  }
  try {
    const ddacontact::BuiltScene built = ddacontact::build(*reading.scene);
    for (const std::string& note : built.notes) say("{}: note: {}\n", path, note);
    fmt::print("{}: {} blocks, {} unknowns, {} steps: ok\n", path, reading.scene->blocks.size(),
               built.stepper->blocks().n_equations(), reading.scene->n_steps());
  } catch (const ddacontact::Error& error) {
    say("{}:1:1: error: {}\n", path, error.what());
    return wrong_input;
  }
  return status;
}

}  // namespace

int check(const std::vector<std::string>& scenes, const std::vector<std::string>& settings) {
  int worst = done;
  for (const std::string& path : scenes) worst = std::max(worst, check_one(path, settings));
  return worst;
}

}  // namespace dda
