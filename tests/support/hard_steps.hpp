/// \file Steps that can be made again alone: a scene and where its run stood.
#pragma once

#include <ddacontact/scene/builder.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace support {

struct HardStep {
  std::string name;
  ddacontact::Scene scene;
  ddacontact::StepRecord record;
};

void write_hard_step(const std::filesystem::path& path, const ddacontact::Scene& scene,
                     const ddacontact::StepRecord& record);
HardStep read_hard_step(const std::filesystem::path& path);
/// Those of tests/hard_steps, by name.
std::vector<HardStep> hard_steps();

/// The scene built and brought to where the step begins.
ddacontact::BuiltScene build_at(const HardStep& step);

/// The largest area that two blocks have in common, relative to the smaller one's.
double largest_overlap(const ddacontact::Stepper& stepper);

}  // namespace support
