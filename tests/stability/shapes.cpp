// Blocks on which formulas lose digits, materials that do not change their volume, corners that turn concave.
#include "chapters.hpp"
#include "solver_scenes.hpp"

#include <tests/support/random_polygon.hpp>

#include <fmt/format.h>
#include <ddacontact/scene/reader.hpp>
#include <polyfem/geometry/validity.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

namespace stability {

namespace {

struct HardShape {
  const char* name;
  Points outline;
};

Points from_list(const std::vector<Vec2>& vertices) {
  Points polygon(2, static_cast<Index>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) polygon.col(static_cast<Index>(k)) = vertices[k];
  return polygon;
}

std::vector<HardShape> hard_shapes_of_facts() {
  const double cut = 1e-6, turn = 1e-8;
  return {{"aspect 1:1000", rectangle(0, 0, 1000, 1)},
          {"an edge of 1e-6 L", from_list({{0, 0}, {1, 0}, {1, 1 - cut}, {1 - cut, 1}, {0, 1}})},
          {"a corner of pi - 1e-8", from_list({{0, 0}, {0.5, -turn / 4}, {1, 0}, {1, 1}, {0, 1}})},
          {"100 vertices", support::regular_polygon(100)}};
}

struct Model {
  const char* name;
  BlockModel model;
  CellKind cells = CellKind::by_shape;
};
constexpr Model models[] = {{"wachspress", BlockModel::wachspress},
                            {"mean_value", BlockModel::mean_value},
                            {"mesh", BlockModel::mesh},
                            {"affine", BlockModel::affine}};

struct ShapeChecks {
  double unity = 0;  ///< largest |sum of the functions - 1|, on the outline and inside
  double rigid = 0;  ///< elastic force of a turn of 0.3 rad and a translation, over |K| |d|
  bool finite = true;
  std::string refused;
};

/// The sum of a cell's functions at its corners, on its edges and inside.
double defect_of_unity(const Points& corners, const polyfem::Basis& basis) {
  std::vector<Vec2> places{polyfem::area_moments(corners).centroid};
  for (Index k = 0; k < corners.cols(); ++k) {
    const Vec2 a = corners.col(k), b = corners.col((k + 1) % corners.cols());
    for (const double s : {0., 1e-7, 0.4}) places.push_back(a + s * (b - a));
    places.push_back(0.7 * a + 0.3 * places[0]);
  }
  polyfem::ShapeTable table;
  basis.evaluate(corners, from_list(places), table);
  return (table.values.rowwise().sum().array() - 1).abs().maxCoeff();
}

ShapeChecks evaluate(const Points& outline, const Model& model) {
  ShapeChecks of_shape;
  Scene scene = rock_scene(1e-3, 20);
  scene.joints[0].friction_angle = 30;
  const Vec2 low = outline.rowwise().minCoeff(), high = outline.rowwise().maxCoeff();
  const double wide = high.x() - low.x();
  scene.blocks = {block(outline), block(rectangle(low.x() - wide, low.y() - 1.001, 3 * wide, 1), true)};
  scene.blocks[0].model = model.model;
  try {
    // In half steps elastic forces are those of the moved shape, not told apart from inertia.
    Scene whole_steps = scene;
    whole_steps.analysis.scheme = Scheme::backward_euler;
    const StartedBlocks blocks(whole_steps, 1e-3);
    const Block& of = blocks.block(0);
    for (int c = 0; c < of.n_cells(); ++c) {
      const BlockCell cell = of.cell(c);
      of_shape.unity =
          std::max(of_shape.unity, defect_of_unity(of.reference()(Eigen::all, cell.corners), *cell.basis));
    }
    // Any motion as displacements of places: by rigid modes where the unknowns are others.
    if (model.model != BlockModel::affine) {
      const Points about = of.reference().colwise() - polyfem::area_moments(outline).centroid;
      const Mat2 R = Eigen::Rotation2Dd(0.3).toRotationMatrix();
      const Points by = (R * about - about).colwise() + Vec2(0.1, -0.2);
      const VectorXd rigid = by.reshaped();
      std::mt19937 random(1);
      VectorXd any(rigid.size());
      for (double& x : any) x = 1e-6 * support::uniform(-1, 1, random);
      const double stiffness = blocks.elastic_force(0, any).norm() / any.norm();
      of_shape.rigid = blocks.elastic_force(0, rigid).norm() / (stiffness * rigid.norm());
    }
    const BuiltScene built = build(scene);
    for (int k = 0; k < scene.n_steps() && built.stepper->step(); ++k)
      of_shape.finite = of_shape.finite && built.stepper->state().position.allFinite() &&
                        built.stepper->state().stress.allFinite();
    if (!built.stepper->stop_reason().empty()) of_shape.refused = "stopped: " + built.stepper->stop_reason();
  } catch (const polyfem::Error& error) {
    of_shape.refused = error.what();
  }
  return of_shape;
}

}  // namespace

void hard_shapes(Page& page) {
  Report& report =
      page.begin({"Aspect 1:1e3, edges of 1e-6 L, corners of pi - 1e-8, n = 100",
                  "no NaN, partition of unity 1e-13, K x rigid motion at most 1e-10 K",
                  "`WachspressNearStraightCorner`, `WachspressTinyEdge`, `WachspressManyVertices`, "
                  "`MeanValue*`, `Outline.ThinAndTinyBlocksAreAccepted`"});
  std::vector<std::vector<std::string>> rows{{"block", "model", "partition of unity",
                                              "force of a turn by 0.3 rad, over K d", "20 steps on a floor"}};
  double unity = 0, rigid = 0;
  int n_bad = 0;
  for (const HardShape& shape : hard_shapes_of_facts())
    for (const Model& model : models) {
      const ShapeChecks of_shape = evaluate(shape.outline, model);
      unity = std::max(unity, of_shape.unity);
      rigid = std::max(rigid, of_shape.rigid);
      const bool ends_well = of_shape.finite && of_shape.refused.empty();
      n_bad += !ends_well;
      rows.push_back({shape.name, model.name, figure(of_shape.unity), figure(of_shape.rigid),
                      ends_well                  ? "finite"
                      : of_shape.refused.empty() ? "**NaN**"
                                                 : of_shape.refused});
    }
  report.table(rows);
  page.claims(
      {{"Partition of unity to 1e-13.", unity <= 1e-13, figure(unity)},
       {"K times a rigid motion at most 1e-10 K.", rigid <= 1e-10, figure(rigid)},
       {"No NaN; none is refused or stops.", n_bad == 0, fmt::format("{} of {}", n_bad, rows.size() - 1)}});
}

namespace {

/// The largest sag of a cantilever of 8 x 1 m under its own weight, of `cells` quads, over that of a beam in
/// plane strain with shear.
double sag(double poisson, int cells) {
  Scene scene = rock_scene(1, 5, 1e9);
  scene.analysis.mode = Mode::statics;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials[0].poisson = poisson;
  scene.blocks = {block(rectangle(0, 0, 8, 1))};
  scene.blocks[0].model = BlockModel::mesh;
  scene.blocks[0].mesh.cells = cells;
  scene.blocks[0].fixed_vertices = {3, 0};
  const BuiltScene built = verification::run(scene);
  const double w = 2500 * gravity, L = 8, E = 1e9 / (1 - poisson * poisson), G = 1e9 / 2 / (1 + poisson);
  const double beam = w * std::pow(L, 4) / (8 * E / 12) + w * L * L / (2 * G * 5 / 6);
  return -built.stepper->blocks().displacements(built.stepper->state()).row(1).minCoeff() / beam;
}

}  // namespace

void incompressible(Page& page) {
  Report& report =
      page.begin({"nu = .499999; nu >= .5", "accurate with B-bar; refused by name",
                  "`BBar*`, `MeshBlock.BendsAsABeamDoes`, doc/benchmarks/polyfem.md (incompressible)"});
  std::vector<std::vector<std::string>> rows{{"cells", "nu = .3", "nu = .49", "nu = .4999", "nu = .499999"}};
  double worst = 0;
  std::vector<double> sags;
  for (const int cells : {128, 512, 2048}) {
    std::vector<std::string> row{fmt::format("{}", cells)};
    for (const double poisson : {0.3, 0.49, 0.4999, 0.499999}) {
      const double ratio = sag(poisson, cells);
      row.push_back(fmt::format("{:.4f}", ratio));
      sags.push_back(ratio);
    }
    rows.push_back(row);
  }
  const std::size_t n = 4;  // Poisson's ratios
  for (std::size_t k = 0; k < n; ++k) worst = std::max(worst, std::abs(sags[n + k] / sags[2 * n + k] - 1));
  const double softening = std::abs(sags[2 * n + 3] / sags[2 * n + 2] - 1);
  report.paragraph(
      "A cantilever of 8 x 1 m under its weight, of quads with B-bar where the material is next to "
      "incompressible. The table has its sag over that of a beam in plane strain with shear, whose end is "
      "not hindered from becoming wider as a clamped one is.");
  report.table(rows);

  int refused = 0, tried = 0;
  std::string message;
  for (const double poisson : {0.5, 0.50001, 0.7, 1e300}) {
    ++tried;
    const std::string text = fmt::format(
        "format = 1\n[analysis]\nsteps = 1\ntime_step = 0.1\n[[material]]\nname = \"rubber\"\ndensity = "
        "1000\n"
        "young = 1e6\npoisson = {}\n[[joint]]\nname = \"j\"\n[[block]]\nmaterial = \"rubber\"\nvertices = "
        "[[0, 0], [1, 0], [1, 1], [0, 1]]\nfixed = true\n",
        poisson);
    const SceneReading reading = read_scene_text(text, "scene.toml");
    if (reading.scene) continue;
    message = reading.problems.front().text();
    refused += message.find("poisson") != std::string::npos;
  }
  page.claims({{"512 cells have the sag of 2048 to 2 % at every nu to .499999.", worst <= 0.02,
                fmt::format("{:.2f} %", 100 * worst)},
               {"nu = .499999 is as .4999 to 1e-3: nothing locks.", softening <= 1e-3, figure(softening)},
               {"nu of .5 and more is refused by name.", refused == tried, message}});
}

namespace {

/// A pentagon with a corner that turns by `turn` is pushed in at it.
Scene pushed_corner(double turn, Kinematics kinematics) {
  Scene scene = rock_scene(2e-3, 100, 1e7);
  scene.analysis.gravity.setZero();
  scene.analysis.kinematics = kinematics;
  if (kinematics == Kinematics::incremental) scene.analysis.scheme = Scheme::dda;
  scene.blocks = {block(from_list({{0, 0}, {2, 0}, {2, 1}, {1, 1 + turn / 2}, {0, 1}}))};
  scene.blocks[0].fixed_vertices = {0, 1};
  Load push;
  push.block = 0;
  push.at = {1, 1 + turn / 2};
  push.force = {TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {0.1, 0, -5e5}, {0.2, 0, -5e5}}};
  scene.loads = {push};
  return scene;
}

}  // namespace

void concave_corners(Page& page) {
  Report& report =
      page.begin({"Corner turns concave during the run",
                  "noticed in that step; falls back or stops, never wrong shape functions",
                  "`CellView.AWachspressCellThatTurnedConcaveIsDrawnAllTheSame`, `CorotationalBlock*`"});
  report.paragraph(
      "A block of 2 x 1 m with a corner in its top edge that turns by 1e-2 and by 1e-6. A force that grows "
      "pushes it in there; E = 10 MPa. The outline is looked at after every step. (A Wachspress function of "
      "a corner next to straight is a spike along the edge. With the block's rule it is too soft to push in, "
      "and has next to no mass. `auto` gives such blocks mean value functions.)");
  bool all_noticed = true, all_sound = true;
  double least_mass = 1, mass_error = 0;
  std::vector<std::vector<std::string>> rows{{"kinematics", "turn", "step of the first concave corner",
                                              "step of the note", "lowest corner, m", "what it says"}};
  for (const Kinematics kinematics : {Kinematics::corotational, Kinematics::incremental})
    for (const double turn : {1e-2, 1e-6}) {
      const Scene scene = pushed_corner(turn, kinematics);
      const BuiltScene built = build(scene);
      const Stepper& stepper = *built.stepper;
      int concave_at = 0, noted_at = 0;
      for (int k = 1; k <= scene.n_steps() && built.stepper->step(); ++k) {
        const Points outline = stepper.state().position;
        const bool concave = polyfem::find_non_convex_corner(outline).has_value();
        if (concave && concave_at == 0) concave_at = k;
        if (!stepper.notes().empty() && noted_at == 0) noted_at = k;
        all_sound = all_sound && outline.allFinite() && stepper.state().stress.allFinite();
        const Block& of = stepper.blocks().block(0);
        const MatrixXd M = of.mass();
        const auto& shift = of.translations();
        least_mass =
            std::min(least_mass,
                     Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues().minCoeff() / of.mass_total());
        mass_error =
            std::max(mass_error, (shift.transpose() * M * shift / of.mass_total() - Mat2::Identity()).norm());
      }
      all_noticed = all_noticed && concave_at > 0 && noted_at == concave_at;
      rows.push_back({kinematics == Kinematics::corotational ? "corotational" : "incremental", figure(turn),
                      fmt::format("{}", concave_at), fmt::format("{}", noted_at),
                      fmt::format("{:.4f}", stepper.blocks().displacements(stepper.state())(1, 3)),
                      stepper.notes().empty() ? stepper.stop_reason() : stepper.notes().front()});
    }
  report.table(rows);
  page.claims({{"The step in which a corner turns concave says so.", all_noticed, "in all four runs"},
               {"The functions after it are sound on a concave shape: masses positive and their sum kept to "
                "1e-12, stresses finite.",
                all_sound && least_mass > 0 && mass_error <= 1e-12,
                fmt::format("least mass {} of the block's, sum kept to {}", figure(least_mass),
                            figure(mass_error))}});
}

}  // namespace stability
