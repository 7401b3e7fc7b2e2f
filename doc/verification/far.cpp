#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace verification {

namespace {

/// A pile that slides, tips over an edge and falls on, with coordinates that are multiples of 2^-20 m.
Scene pile(const Vec2& at) {
  Scene scene = rock_scene(1. / 128, 200);
  scene.joints[0].friction_angle = 25;
  const auto leaning = [](double x, double y, double width, double height, double angle) -> Points {
    const Points p = turned(rectangle(0, 0, width, height), angle).colwise() + Vec2(x, y);
    return (p.array() * 1048576).round() / 1048576;
  };
  scene.blocks = {block(rectangle(0, -1, 3, 1), true), block(leaning(2.2, 0, 1.5, 0.8, 0.05)),
                  block(rectangle(1, 1.125, 2, 0.5)), block(leaning(0.25, 0.25, 0.75, 0.75, 0.4)),
                  block(rectangle(-4, -4, 12, 1), true)};
  scene.blocks[1].velocity = {0.5, 0};
  scene.blocks[2].model = BlockModel::affine;
  for (BlockDescription& description : scene.blocks) description.vertices.colwise() += at;
  return scene;
}

}  // namespace

void far_from_the_origin(Report& report) {
  report.heading("9. Far from the origin");
  report.paragraph(
      "A pile of three blocks slides, tips over an edge and falls on a lower floor in 200 steps of 1/128 s. "
      "It is compared with the same pile with all coordinates larger by (5e5, 4e6) m, as a map would have "
      "them.");
  const BuiltScene here = run(pile({0, 0})), there = run(pile({5e5, 4e6}));
  const Stepper &a = *here.stepper, &b = *there.stepper;
  const double apart =
      (a.blocks().displacements(a.state()) - b.blocks().displacements(b.state())).colwise().norm().maxCoeff();
  const double moved = a.blocks().displacements(a.state()).colwise().norm().maxCoeff();
  const bool same = a.counts().substeps == b.counts().substeps &&
                    a.counts().rejected == b.counts().rejected &&
                    a.counts().contact_iterations == b.counts().contact_iterations;
  report.claims(
      {{"The same steps and solutions.", same,
        fmt::format("{} substeps, {} solutions", a.counts().substeps, a.counts().contact_iterations)},
       {"Displacements are the same to 1e-9 of a block.", apart <= 1e-9 * 0.75,
        fmt::format("{} m, of up to {:.1f} m", text(apart), moved)}});
}

}  // namespace verification
