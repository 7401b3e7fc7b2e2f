/// \file Runs of the paper's scenes, and their stresses as the figures show them.
#pragma once

#include <ddacontact/output/frame.hpp>
#include <ddacontact/scene/builder.hpp>

#include <string>
#include <vector>

namespace verification {

using namespace ddacontact;

constexpr const char* models[] = {"affine", "wachspress"};
constexpr const char* model_names[] = {"original DDA", "Wachspress"};

/// A scene of examples/paper after some steps.
struct Run {
  BuiltScene built;
  Frame frame;

  const Stepper& stepper() const { return *built.stepper; }
};

/// \param[in] steps  0: as many as the scene says
/// Throws Error when the scene has problems or the run stops.
Run run_scene(const std::string& name, const std::string& model, int steps = 0,
              std::vector<std::string> settings = {});

struct Sample {
  Vec2 position{0, 0};
  double s1 = 0, s2 = 0;
};

/// Principal stresses inside a block at the nodes of a fine triangulation, the outline's corners included.
std::vector<Sample> samples(const Frame& frame, int block);

struct Extremes {
  Sample least_s1, most_s1, least_s2, most_s2;
};
Extremes extremes(const std::vector<Sample>& samples);

/// The part of the samples, by number, with a property.
template <class Property>
double part(const std::vector<Sample>& samples, const Property& property) {
  int n = 0;
  for (const Sample& sample : samples) n += property(sample);
  return static_cast<double>(n) / static_cast<double>(samples.size());
}

/// The corner of a block nearest to a point.
int nearest_corner(const Frame& frame, int block, const Vec2& point);

/// A frame of one block alone, its centroid at the origin: for figures of blocks in different places.
Frame alone(const Frame& frame, int block);

}  // namespace verification
