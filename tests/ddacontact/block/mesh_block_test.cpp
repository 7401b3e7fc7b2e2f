#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <polyfem/quadrature/gauss_rule.hpp>

using namespace support;

namespace {

struct Shape {
  const char* name;
  BlockModel model;
  CellKind kind;
  bool edge_nodes;
  Points outline;
};

Points L() {
  return points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
}
Points bar() {
  return rectangle(0, 0, 4, 1);
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      {"mean_value", BlockModel::mean_value, {}, true, L()},
      {"middles", BlockModel::mean_value, {}, true, points({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}})},
      {"voronoi", BlockModel::mesh, CellKind::voronoi, true, L()},
      {"voronoi_straight_edges", BlockModel::mesh, CellKind::voronoi, false, L()},
      {"quads", BlockModel::mesh, CellKind::quads, true, bar()}};
  return all;
}

Scene one_block(const Shape& shape, double poisson = 0.3) {
  Scene scene;
  scene.analysis.gravity = {0, 0};
  scene.analysis.time_step = 1e-2;
  scene.materials = {{"rock", 2500, 1e9, poisson}};
  scene.joints = {{"joint", 30, 0, 0, std::nullopt, 0, 0}};
  scene.contact.normal_stiffness = 4e10;
  scene.contact.tangential_stiffness = 1.6e10;
  BlockDescription one = block(shape.outline);
  one.model = shape.model;
  one.mesh = {shape.kind, 40, 0, shape.edge_nodes};
  scene.blocks = {one};
  return scene;
}

class AnyShape : public testing::TestWithParam<Shape> {
 protected:
  BuiltScene built = build(one_block(GetParam()));
  BlockSystem& system = blocks_of(built);
  const Block& block = system.block(0);
  BlockState state = built.stepper->state();

  /// Displacements of the unknowns that move every place by u0 + G (x - centroid).
  VectorXd affine(const Vec2& u0, const Mat2& G) const {
    MatrixXd maps = MatrixXd::Zero(2 * block.n_points(), block.n_unknowns());
    VectorXd wanted(2 * block.n_points());
    for (int p = 0; p < block.n_points(); ++p) {
      for (int u = 0; u < block.n_unknowns(); ++u)
        maps.block<2, 1>(2 * p, u) = block.vertex_map(p)(VectorXd::Unit(block.n_unknowns(), u));
      wanted.segment<2>(2 * p) = u0 + G * (state.position.col(p) - block.moments(state).centroid);
    }
    const VectorXd d = maps.colPivHouseholderQr().solve(wanted);
    EXPECT_LE((maps * d - wanted).norm(), 1e-11 * wanted.norm()) << "affine motions are among its own";
    return d;
  }
};

INSTANTIATE_TEST_SUITE_P(Of, AnyShape, testing::ValuesIn(shapes()),
                         [](const auto& of) { return std::string(of.param.name); });

TEST_P(AnyShape, HasTheMassAndInertiaOfItsOutline) {
  const auto Z = block.rigid_modes(state);
  const Eigen::Matrix3d inertia = Z.transpose() * block.times_mass(Z);
  const polyfem::AreaMoments of = polyfem::area_moments(GetParam().outline);
  const Vec3 expected = 2500 * Vec3(of.area, of.area, of.second.trace());
  EXPECT_LE((inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-10 * expected.norm());
}

TEST_P(AnyShape, LinearDisplacementsMakeAUniformStressAndNoForceInside) {
  Mat2 G;
  G << 2e-6, 1e-6, 1e-6, -3e-6;
  state.coordinates.resize(0);  // the step is of Newmark's family
  std::unique_ptr<BlockStep> step;
  block.begin_step(state, step_start(state, 1e3), step);
  BlockState next = state;
  const VectorXd d = affine({0, 0}, G);
  step->end(d, VectorXd::Zero(d.size()), true, next);
  const Vec3 expected = block.material().elasticity * Vec3(G(0, 0), G(1, 1), G(0, 1) + G(1, 0));
  const Tensors stress = block.stress(next);
  EXPECT_LE((stress.colwise() - expected).colwise().norm().maxCoeff(), 1e-8 * expected.norm());
  for (int c = 0; c < block.n_cells(); ++c) {
    const CellStress of = block.cell_stress(next, c);
    const BlockCell cell = block.cell(c);
    const Points corners = next.position(Eigen::all, cell.corners);
    polyfem::ShapeValues shape;
    (*cell.basis)(corners, corners.rowwise().mean(), shape);
    const Mat2 gradient = of.strain_displacement * shape.gradients.transpose();
    const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
    EXPECT_LE((of.elasticity * strain + of.offset - expected).norm(), 1e-5 * expected.norm());
  }
  BlockForces forces;
  step->forces(d, forces);
  for (int p = block.n_vertices(); GetParam().edge_nodes && p < block.n_points(); ++p)
    EXPECT_LE(forces.elastic().segment<2>(2 * p).norm(), 1e-5 * forces.elastic().norm());
}

TEST_P(AnyShape, AMaterialPointIsASumOfPlaces) {
  for (const Vec2& x : {Vec2(0.3, 0.4), Vec2(1.9, 0.9), Vec2(0, 0), Vec2(1, 0)}) {
    const VectorXd weights = block.point_weights(x);
    EXPECT_NEAR(weights.sum(), 1, 1e-13);
    EXPECT_LE((block.reference() * weights - x).norm(), 1e-12);
  }
}

TEST_P(AnyShape, TurnsFreelyWithItsMomentaAndEnergy) {
  for (double dt : {1e-2, 1e-4}) {
    Scene scene = one_block(GetParam());
    scene.analysis.time_step = dt;
    scene.analysis.scheme = Scheme::midpoint;
    scene.blocks[0].angular_velocity = 6;
    scene.blocks[0].velocity = {3, 1};
    const BuiltScene flying = build(scene);
    Stepper& stepper = *flying.stepper;
    const auto momenta = [&]() -> Vec3 {
      const Block& of = stepper.blocks().block(0);
      return of.rigid_modes(stepper.state()).transpose() * of.times_mass(stepper.state().velocity);
    };
    const auto energy = [&] { return stepper.energy().now.kinetic + stepper.energy().now.elastic; };
    const Vec3 before = momenta();
    const double start = energy();
    run(stepper, 100);
    EXPECT_LE((momenta() - before).norm(), 1e-12 * before.norm());
    EXPECT_NEAR(energy(), start, 1e-11 * start);
    EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-8);
    const double stretch =
        stepper.blocks().block(0).moments(stepper.state()).area / polyfem::signed_area(GetParam().outline);
    EXPECT_NEAR(stretch, 1, 3e-4) << "by the centrifugal force";
  }
}

/// U of a bar bent by moments at its ends over that of a beam in plane strain, M^2 L / (2 E' I).
double compliance(BlockModel model, const MeshOptions& mesh, double poisson) {
  Scene scene = one_block({"", model, CellKind::quads, true, bar()}, poisson);
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = 1;
  scene.analysis.steps = 4;
  scene.blocks[0].mesh = mesh;
  const double moment = 1e3;
  const polyfem::GaussRule gauss = polyfem::gauss_rule(2);
  const int parts = 32;
  for (double end : {0., 4.})
    for (int k = 0; k < parts; ++k)
      for (Index q = 0; q < 2; ++q) {
        const double y = (k + gauss.points[q]) / parts, traction = 6 * moment * (2 * y - 1);
        scene.loads.push_back(
            point_load(0, {end, y}, constant({(end > 0 ? 1 : -1) * traction * gauss.weights[q] / parts, 0})));
      }
  const BuiltScene bent = run(scene);
  const double E = 1e9 / (1 - poisson * poisson);
  return bent.stepper->energy().now.elastic / (moment * moment * 4 / (2 * E / 12));
}

TEST(MeshBlock, BendsAsABeamDoes) {
  EXPECT_NEAR(compliance(BlockModel::wachspress, {}, 0.3), 0.1465, 1e-4);
  MeshOptions mesh;
  mesh.cells = 64;
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.3), 1, 0.04);
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.4999), 1, 0.02) << "does not lock";
  mesh.kind = CellKind::voronoi;
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.3), 1, 0.05);
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.4999), 1, 0.02);
  mesh.edge_nodes = false;
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.3), 0.16, 0.01) << "straight edges hinder it";
  mesh = {};
  mesh.cells = 256;
  EXPECT_NEAR(compliance(BlockModel::mesh, mesh, 0.3), 1, 0.01);
}

/// One list that has both ends of an edge holds all of it; reactions carry the weight.
TEST(MeshBlock, AnEdgeIsHeldWhereItsEndsAre) {
  Scene scene = one_block({"", BlockModel::mesh, CellKind::quads, true, bar()});
  scene.analysis.gravity = {0, -10};
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = 1;
  scene.analysis.steps = 5;
  scene.blocks[0].mesh.cells = 256;
  scene.blocks[0].fixed_vertices = {3, 0};
  const BuiltScene held = run(scene);
  const Stepper& stepper = *held.stepper;
  const Points moved = stepper.blocks().displacements(stepper.state());
  double furthest = 0;
  for (int p = 0; p < stepper.blocks().block(0).n_points(); ++p)
    if (stepper.blocks().reference()(0, p) == 0) furthest = std::max(furthest, moved.col(p).norm());
  EXPECT_EQ(furthest, 0);
  EXPECT_NEAR(stepper.reactions().row(1).sum(), 4 * 2500 * 10, 1e-6 * 1e5);
  // A cantilever with shear: w L^4 / (8 E' I) + w L^2 / (2 G A 5/6), held against contraction at the wall.
  const double E = 1e9 / 0.91, tip = 25e3 * 256 / (8 * E / 12) + 25e3 * 16 / (2 * 1e9 / 2.6 * 5 / 6);
  EXPECT_NEAR(-moved.row(1).minCoeff(), tip, 0.05 * tip);
}

/// Corners held by supports of their own are points: the edge between them bends.
TEST(MeshBlock, AnEdgeBetweenTwoSupportsIsFree) {
  Scene scene = one_block({"", BlockModel::mesh, CellKind::quads, true, rectangle(0, 0, 8, 1)});
  scene.analysis.gravity = {0, -10};
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = 1;
  scene.analysis.steps = 5;
  scene.blocks[0].mesh.cells = 256;
  for (int corner = 0; corner < 2; ++corner) {
    Support support;
    support.block = 0;
    support.vertices = {corner};
    support.fix_x = corner == 0;
    support.fix_y = true;
    scene.supports.push_back(support);
  }
  const BuiltScene beam = run(scene);
  const Stepper& stepper = *beam.stepper;
  EXPECT_NEAR(stepper.reactions()(1, 0), 4 * 25e3, 1e-6 * 1e5);
  EXPECT_NEAR(stepper.reactions().row(1).sum(), 8 * 25e3, 1e-6 * 1e5);
  // Simply supported: 5 w L^4 / (384 E' I) + w L^2 / (8 G A 5/6).
  const double E = 1e9 / 0.91, sag = 5 * 25e3 * 4096 / (384 * E / 12) + 25e3 * 64 / (8 * 1e9 / 2.6 * 5 / 6);
  const double lowest = -stepper.blocks().displacements(stepper.state()).row(1).minCoeff();
  EXPECT_NEAR(lowest, sag, 0.06 * sag);
}

/// On a floor under its weight, with nodes on its edges or without.
TEST(MeshBlock, RestsOnAFloor) {
  for (const Shape& shape : shapes()) {
    Scene scene = one_block(shape);
    scene.analysis.gravity = {0, -10};
    scene.analysis.steps = 200;
    scene.blocks.push_back(block(rectangle(-5, -1, 15, 1), true));
    const BuiltScene resting = run(scene);
    const double weight = 25000 * polyfem::signed_area(shape.outline);
    const double of_floor = 25000 * 15;
    EXPECT_NEAR(resting.stepper->reactions().row(1).sum() - of_floor, weight, 1e-6 * weight) << shape.name;
    EXPECT_LE(resting.stepper->state().velocity.norm(), 1e-4) << shape.name;
  }
}

}  // namespace
