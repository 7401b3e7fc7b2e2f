/// \file Reads, builds and runs a scene file inside a test.
#pragma once

#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/reader.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace support {

/// A scene of examples/ with `--set` settings, built. Fails the test when it has problems.
inline ddacontact::BuiltScene build_example(const std::string& name,
                                            const std::vector<std::string>& settings = {}) {
  const ddacontact::SceneReading reading = ddacontact::read_scene(POLYDDA_EXAMPLES "/" + name, settings);
  for (const ddacontact::Problem& problem : reading.problems) ADD_FAILURE() << problem.text();
  if (!reading.scene) throw std::runtime_error("no scene");
  return ddacontact::build(*reading.scene);
}

/// Runs `steps` steps; false when the stepper has to stop.
[[nodiscard]] inline bool run(ddacontact::Stepper& stepper, int steps) {
  for (int i = 0; i < steps; ++i)
    if (!stepper.step()) return false;
  return true;
}

}  // namespace support
