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

/// Blocks on a held floor, brought to rest.
Scene on_floor(double friction_angle, std::initializer_list<Points> outlines) {
  Scene scene = rock_scene(0.05, 40, 1e9);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = friction_angle;
  for (const Points& outline : outlines) scene.blocks.push_back(block(outline));
  scene.blocks.push_back(block(rectangle(-1, -0.5, 4, 0.5), true));
  set_default_springs(scene);
  return scene;
}

Scene ell() {
  Points outline(2, 6);
  outline << 0, 2, 2, 0.5, 0.5, 0, 0, 0, 0.4, 0.4, 2, 2;
  return on_floor(30, {outline, rectangle(1.2, 0.4, 0.7, 0.7)});
}

Scene notch() {
  Points outline(2, 7), wedge(2, 4);
  outline << 0, 2, 2, 1.4, 1, 0.6, 0, 0, 0, 2, 2, 0.8, 2, 2;
  wedge << 0.9, 1.1, 1.5, 0.5, 1.1, 1.1, 2.3, 2.3;
  return on_floor(10, {outline, wedge});
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

/// By how much the mean stresses of the blocks differ, relative to the largest.
struct Apart {
  double worst = 0, root_mean_square = 0;
  int n_over = 0;  ///< blocks with more than 5 %
};

Apart apart(const Solved& solution, const Solved& fine) {
  double largest = 0, squares = 0;
  for (Index b = 0; b < fine.mean.cols(); ++b) largest = std::max(largest, norm(fine.mean.col(b)));
  Apart found;
  for (Index b = 0; b < fine.mean.cols(); ++b) {
    const double d = norm(solution.mean.col(b) - fine.mean.col(b)) / largest;
    found.worst = std::max(found.worst, d);
    found.n_over += d > 0.05;
    squares += d * d;
  }
  found.root_mean_square = std::sqrt(squares / static_cast<double>(fine.mean.cols()));
  return found;
}

}  // namespace

void choice(Report& report) {
  report.heading("5. What `auto` chooses, against meshes");
  report.paragraph(
      "Static steps under the default preset: the paper's slider and arch, and three scenes of rock of 1 GPa "
      "(30 degrees of friction, 10 between wedge and notch). Every free block is a single polygon, as `auto` "
      "has it, and a mesh. Difference: of the mean stress of a block from that of the meshes, relative to "
      "the largest mean stress in the scene. Most scenes are at rest in the end; the sliding blocks move on, "
      "but their stress is steady after twenty steps.");
  std::vector<std::vector<std::string>> rows{{"scene", "steps", "cells", "unknowns: single", "auto", "mesh",
                                              "single, worst", "auto, worst", "auto, root mean square",
                                              "auto, blocks over 5 %"}};
  double worst[2] = {0, 0}, divided = 0, most = 0;
  std::vector<Frame> frames;
  struct Case {
    const char* name;
    Scene scene;
    int cells;
    bool concave, shown;
  };
  for (const Case& of : {Case{"sliding_0", example("sliding_0.toml", 20), 256, false, false},
                         Case{"sliding_15", example("sliding_15.toml", 20), 256, false, false},
                         Case{"sliding_30", example("sliding_30.toml", 20), 256, false, false},
                         Case{"sliding_40", example("sliding_40.toml", 20), 256, false, false},
                         Case{"arch_friction30", example("arch_friction30.toml", 60), 256, false, false},
                         Case{"arch_frictionless, as it begins to fall", example("arch_frictionless.toml", 3),
                              256, false, false},
                         Case{"beam on two pillars", portal(), 256, false, true},
                         Case{"L with a square on its foot", ell(), 256, true, true},
                         Case{"wedge in a notch", notch(), 256, true, true}}) {
    const Solved fine = solved(of.scene, BlockModel::mesh, of.cells),
                 chosen = solved(of.scene, BlockModel::automatic, of.cells),
                 single = solved(of.scene, BlockModel::mean_value, 1);
    const Apart by_auto = apart(chosen, fine), by_single = apart(single, fine);
    worst[of.concave] = std::max(worst[of.concave], by_auto.worst);
    if (of.concave) divided = std::max(divided, apart(solved(of.scene, BlockModel::mesh, 16), fine).worst);
    most = std::max(most, static_cast<double>(chosen.unknowns) / fine.unknowns);
    rows.push_back({of.name, fmt::format("{}", of.scene.analysis.steps), fmt::format("{}", of.cells),
                    fmt::format("{}", single.unknowns), fmt::format("{}", chosen.unknowns),
                    fmt::format("{}", fine.unknowns), text(by_single.worst), text(by_auto.worst),
                    text(by_auto.root_mean_square),
                    fmt::format("{} of {}", by_auto.n_over, fine.mean.cols())});
    if (!of.shown) continue;
    for (const Solved* solution : {&single, &chosen, &fine})
      frames.push_back(capture_frame(*solution->built.stepper, solution->built.labels, {}));
  }
  report.table(rows);
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < frames.size(); ++k)
    panels.push_back({.frame = &frames[k],
                      .field = Field::s1,
                      .caption = k % 3 == 0   ? "single polygons"
                                 : k % 3 == 1 ? "auto"
                                              : "256 cells",
                      .scene = static_cast<int>(k / 3)});
  report.picture(
      "blocks_choice",
      draw(panels,
           {.title = "Largest principal stress", .width = 1000, .columns = 3, .sharing = RangeSharing::rows}),
      "Largest principal stress: single polygons, what `auto` chooses, meshes of 256 cells.");
  report.paragraph(fmt::format(
      "`auto` leaves concave blocks that are not slender single mean value polygons, whatever loads them: "
      "these know nothing of arms that bend. Divided into 16 cells each both "
      "scenes with a concave block are within {} of the mesh of 256.",
      text(divided)));
  report.claims({{"Mean stresses of `auto` within 5 % of those of meshes: slider, arch and beam.",
                  worst[0] <= 0.05, text(worst[0])},
                 {"The same of concave blocks under load.", worst[1] <= 0.05, text(worst[1])},
                 {"At a third of the unknowns or fewer.", most <= 1. / 3, fmt::format("{:.2f}", most)}});
}

}  // namespace verification
