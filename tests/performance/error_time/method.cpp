#include <tests/performance/error_time/method.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>

namespace error_time {

using namespace ddacontact;

namespace {

constexpr double settling_friction = 45;  // degrees
constexpr int cells_of_a_mesh = 16;

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> methods{
      {.name = "default",
       .description = "staged contacts, corotational blocks, scheme `decaying`, model `auto`"},
      {.name = "classic",
       .description = "classical DDA: the preset `paper` with `block_model = \"affine\"`",
       .model = BlockModel::affine,
       .scheme = Scheme::dda,
       .paper = true},
      {.name = "paper",
       .description =
           "the preset of that name: Wachspress blocks by increments, Newmark (1/2, 1), open-close",
       .model = BlockModel::wachspress,
       .scheme = Scheme::dda,
       .paper = true},
      {.name = "explicit",
       .description = "the scheme of central differences, in substeps of at most the critical step; contacts to "
                      "1e-3 of a block's forces",
       .scheme = Scheme::central_difference},
      {.name = "midpoint", .description = "the scheme that keeps energy", .scheme = Scheme::midpoint},
      {.name = "dda", .description = "the scheme Newmark (1/2, 1)", .scheme = Scheme::dda},
      {.name = "backward_euler", .description = "that scheme", .scheme = Scheme::backward_euler},
      {.name = "affine", .description = "that model of every block", .model = BlockModel::affine},
      {.name = "wachspress", .description = "that model of every block", .model = BlockModel::wachspress},
      {.name = "mesh", .description = "16 cells in every block", .model = BlockModel::mesh},
      {.name = "tolerance 1e-4",
       .description = "`penetration_tolerance` of 1e-4 of a block instead of 1e-6",
       .penetration_tolerance = 1e-4},
      {.name = "tolerance 1e-8", .description = "of 1e-8", .penetration_tolerance = 1e-8},
      {.name = "contacts to 1e-3",
       .description = "`contact.tolerance` of 1e-3 of a block's forces instead of 1e-8",
       .contact_tolerance = 1e-3}};
  return methods;
}

const Method& method_of(const std::string& name) {
  const auto& methods = all_methods();
  const auto found = std::ranges::find(methods, name, &Method::name);
  if (found == methods.end()) throw Error("there is no method \"" + name + "\"");
  return *found;
}

void apply(const Method& method, Scene& scene) {
  AnalysisOptions& analysis = scene.analysis;
  analysis.scheme = method.scheme;
  scene.contact.penetration_tolerance = method.penetration_tolerance;
  scene.contact.tolerance = method.contact_tolerance;
  for (BlockDescription& block : scene.blocks)
    if (!block.fixed) {
      block.model = method.model;
      block.mesh.cells = cells_of_a_mesh;
    }
  if (!method.paper) return;
  analysis.preset = Preset::paper;
  analysis.kinematics = Kinematics::incremental;
  analysis.gradient_correction = GradientCorrection::off;
  analysis.cutting_factor = 0.3;
  scene.contact.method = ContactMethod::classic;
  scene.contact.penetration_tolerance = 0;
}

void settle_first(Scene& scene, int steps, double time_step) {
  StageDescription settling = scene.stage("settle");
  settling.analysis.mode = Mode::statics;
  settling.analysis.steps = steps;
  settling.analysis.time_step = time_step;
  // Static steps by midpoint alternate about the equilibrium.
  if (scene.contact.method == ContactMethod::staged) settling.analysis.scheme = Scheme::decaying;
  for (Joint& joint : settling.joints) joint.friction_angle = settling_friction;
  scene.stages = {settling, scene.stage("let go")};
}

}  // namespace error_time
