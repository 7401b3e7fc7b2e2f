#include "runs.hpp"

#include <ddacontact/picture/fan_mesh.hpp>
#include <ddacontact/picture/field.hpp>
#include <ddacontact/scene/reader.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>

namespace verification {

namespace {
constexpr int rings = 16;  // of the triangulation that stresses are looked at on
}

Run run_scene(const std::string& name, const std::string& model, int steps,
              std::vector<std::string> settings) {
  settings.push_back("analysis.block_model=" + model);
  const SceneReading reading = read_scene(POLYDDA_EXAMPLES "/paper/" + name + ".toml", settings);
  if (!reading.scene) throw Error(reading.problems.front().text());
  Run run{build(*reading.scene), {}};
  if (steps == 0) steps = reading.scene->analysis.steps;
  for (int k = 0; k < steps; ++k)
    if (!run.built.stepper->step()) throw Error(name + ": " + run.stepper().stop_reason());
  run.frame = capture_frame(run.stepper(), run.built.labels, {});
  return run;
}

std::vector<Sample> samples(const Frame& frame, int block) {
  CellField s1(frame, block, Field::s1), s2(frame, block, Field::s2);  // each block is one cell
  const FanMesh mesh(static_cast<int>(s1.corners().cols()), rings);
  const Points nodes = mesh.nodes(s1.corners(), polyfem::area_moments(s1.corners()).centroid);
  std::vector<Sample> found;
  for (Index k = 0; k < nodes.cols(); ++k)
    found.push_back({nodes.col(k) + frame.outline(block).col(0), s1(nodes.col(k)), s2(nodes.col(k))});
  return found;
}

Extremes extremes(const std::vector<Sample>& samples) {
  const auto by_s1 = [](const Sample& a, const Sample& b) { return a.s1 < b.s1; };
  const auto by_s2 = [](const Sample& a, const Sample& b) { return a.s2 < b.s2; };
  const auto [least_s1, most_s1] = std::minmax_element(samples.begin(), samples.end(), by_s1);
  const auto [least_s2, most_s2] = std::minmax_element(samples.begin(), samples.end(), by_s2);
  return {*least_s1, *most_s1, *least_s2, *most_s2};
}

int nearest_corner(const Frame& frame, int block, const Vec2& point) {
  Index nearest = 0;
  (frame.outline(block).colwise() - point).colwise().norm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

Frame alone(const Frame& frame, int block) {
  const Range& vertices = frame.blocks[block];
  const auto of_block = [&](const Points& all) -> Points {
    return all.middleCols(vertices.first, vertices.count);
  };
  Frame one = frame;
  one.blocks = {{0, vertices.count}};
  one.materials = {frame.materials[block]};
  one.position = of_block(frame.position);
  one.position.colwise() -= polyfem::area_moments(one.position).centroid;
  one.displacement = of_block(frame.displacement);
  one.velocity = of_block(frame.velocity);
  one.strain_displacement = of_block(frame.strain_displacement);
  one.stress_offset = frame.stress_offset.col(block);
  one.mean_stress = frame.mean_stress.col(block);
  one.cells.clear();
  one.corner_points.clear();
  one.add_outline_cell(0);
  one.contacts.clear();
  return one;
}

}  // namespace verification
