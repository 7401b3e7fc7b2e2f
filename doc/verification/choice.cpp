#include "blocks_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/picture/picture.hpp>
#include <ddacontact/scene/reader.hpp>

#include <algorithm>
#include <cmath>

namespace verification {

namespace {

/// Under the default preset, from rest to rest.
Scene example(const std::string& name, int steps) {
  const SceneReading reading = read_scene(
      std::string(POLYDDA_EXAMPLES) + "/paper/" + name,
      {"analysis.preset=default", "analysis.mode=static", fmt::format("analysis.steps={}", steps)});
  if (!reading.scene) throw Error("cannot read " + name);
  return *reading.scene;
}

/// A beam on two pillars with a dart on it.
Scene portal() {
  Scene scene = rock_scene(0.05, 40, 1e9);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = 30;
  Points dart(2, 4);
  dart << 2.5, 3, 3.5, 3, 3.2, 2.5, 3.2, 2.8;
  for (const Points& outline : {rectangle(0, 2, 6, 0.5), rectangle(0, 0, 1, 2), rectangle(5, 0, 1, 2), dart})
    scene.blocks.push_back(block(outline));
  scene.blocks.push_back(block(rectangle(-2, -1, 10, 1), true));
  set_default_springs(scene);
  return scene;
}

struct Solved {
  BuiltScene built;
  Tensors mean;  ///< of every block that moves
  int unknowns;
};

Solved solved(Scene scene, BlockModel model, int cells) {
  for (BlockDescription& block : scene.blocks) {
    block.model = block.fixed ? BlockModel::automatic : model;
    block.mesh = {CellKind::by_shape, cells, 0, true};
  }
  Solved result{run(scene), {}, 0};
  const Stepper& stepper = *result.built.stepper;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) {
    if (!stepper.blocks().is_movable(b)) continue;
    result.mean.conservativeResize(3, result.mean.cols() + 1);
    result.mean.rightCols<1>() = mean_stress(stepper.blocks().block(b), stepper.state());
  }
  result.unknowns = stepper.blocks().n_equations();
  return result;
}

double norm(const Vec3& stress) {
  return std::sqrt(stress[0] * stress[0] + stress[1] * stress[1] + 2 * stress[2] * stress[2]);
}

}  // namespace

void choice(Report& report) {
  report.heading("5. What `auto` chooses, against meshes");
  report.paragraph(
      "Scenes brought to rest by static steps under the default preset, every free block a single polygon, "
      "as `auto` has it, "
      "and a mesh of 256 cells. Difference: of the mean stress of a block from that of the meshes, relative "
      "to the largest "
      "mean stress in the scene.");
  std::vector<std::vector<std::string>> rows{{"scene", "unknowns: single", "auto", "mesh", "single, worst",
                                              "auto, worst", "auto, root mean square"}};
  double worst = 0, most = 0;
  std::vector<Frame> frames;
  struct Case {
    const char* name;
    Scene scene;
  };
  for (const Case& of :
       {Case{"arch, 30 degrees", example("arch_friction30.toml", 60)},
        Case{"block on 30 degrees", example("sliding_30.toml", 10)}, Case{"beam on two pillars", portal()}}) {
    const Solved fine = solved(of.scene, BlockModel::mesh, 256),
                 chosen = solved(of.scene, BlockModel::automatic, 256),
                 single = solved(of.scene, BlockModel::mean_value, 1);
    double largest = 0, off = 0, off_single = 0, squares = 0;
    for (Index b = 0; b < fine.mean.cols(); ++b) largest = std::max(largest, norm(fine.mean.col(b)));
    for (Index b = 0; b < fine.mean.cols(); ++b) {
      const double d = norm(chosen.mean.col(b) - fine.mean.col(b)) / largest;
      off = std::max(off, d);
      squares += d * d;
      off_single = std::max(off_single, norm(single.mean.col(b) - fine.mean.col(b)) / largest);
    }
    worst = std::max(worst, off);
    most = std::max(most, static_cast<double>(chosen.unknowns) / fine.unknowns);
    rows.push_back({of.name, fmt::format("{}", single.unknowns), fmt::format("{}", chosen.unknowns),
                    fmt::format("{}", fine.unknowns), text(off_single), text(off),
                    text(std::sqrt(squares / static_cast<double>(fine.mean.cols())))});
    for (const Solved* solution : {&single, &chosen, &fine})
      frames.push_back(capture_frame(*solution->built.stepper, solution->built.labels, {}));
  }
  report.table(rows);
  std::vector<Panel> panels;
  for (std::size_t k : {0, 1, 2, 6, 7, 8})
    panels.push_back({.frame = &frames[k],
                      .field = Field::s1,
                      .caption = k % 3 == 0   ? "single polygons"
                                 : k % 3 == 1 ? "auto"
                                              : "256 cells"});
  report.picture(
      "blocks_choice",
      draw(panels,
           {.title = "Largest principal stress", .width = 1000, .columns = 3, .sharing = RangeSharing::rows}),
      "Largest principal stress: single polygons, what `auto` chooses, meshes of 256 cells.");
  report.claims({{"Mean stresses of `auto` within 5 % of those of meshes.", worst <= 0.05, text(worst)},
                 {"At a third of the unknowns or fewer.", most <= 1. / 3, fmt::format("{:.2f}", most)}});
}

}  // namespace verification
