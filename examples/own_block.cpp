// A block of one's own: a rigid block with three unknowns, in contact with an elastic block of the library.
//
//   ___________     Unknowns are (u, v, r) about the centroid: a point at distance (x, y) from it moves by
//  |___________|    (u - r y, v + r x). There is no stress and no stiffness, and M = diag(m, m, I).
//     |     |
//     |     | H     The slab rests on an elastic column of Poisson's ratio 0. Under gravity the top of the
//     |     |       column and the whole slab settle by (W + W_c / 2) H / (E B), with the weights W of the
//     |_____|       slab and W_c of the column, whose width is B.
//     ///////
#include <ddacontact/classic/incremental_block.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <ddacontact/time/stepper.hpp>

#include <array>
#include <iostream>

using namespace ddacontact;

/// Rotations are small, as in all incremental blocks. Time integration is that of IncrementalBlock.
class RigidBlock final : public IncrementalBlock {
 public:
  RigidBlock(double density, const PointsRef& outline)
      : IncrementalBlock({Mat3::Identity(), density}, outline), maps_(outline.cols()) {
    RigidBlock::take_shape(outline);
  }

  std::unique_ptr<Block> copy() const override { return std::make_unique<RigidBlock>(*this); }
  int n_unknowns() const override { return 3; }
  int n_stress_points() const override { return 0; }
  bool changes_stress() const override { return false; }
  VectorXd unknown_lengths() const override { return Vec3(1, 1, size()); }
  PointMap vertex_map(int vertex) const override { return PointMap(unknowns().first, maps_[vertex]); }
  void add_body_force(const Vec2& b, VectorXd& F) const override {
    F.segment<2>(unknowns().first) += reference_area() * b;
  }
  void add_stress_forces(const BlockState&, VectorXd&) const override {}
  void add_stress(const VectorXd&, Tensors&) const override {}
  Points strain_displacement(const BlockState&) const override { return Points::Zero(2, n_vertices()); }
  Points integration_points() const override { return Points(2, 0); }

 private:
  void take_shape(const PointsRef& outline) override {
    moments_ = polyfem::area_moments(outline);
    for (int v = 0; v < n_vertices(); ++v) {
      const Vec2 r = outline.col(v) - moments_.centroid;
      maps_[v] = {{{0, Vec2(1, 0)}, {1, Vec2(0, 1)}, {2, Vec2(-r.y(), r.x())}}};
    }
    translations_ = MatrixXd::Identity(3, 2);
    rotation_ = Vec3(0, 0, 1);
    stiffness_ = MatrixXd::Zero(3, 3);
    const Vec3 inertia(moments_.area, moments_.area, moments_.second.trace());
    mass_ = density() * MatrixXd(inertia.asDiagonal());
  }

  std::vector<std::array<PointMap::Term, 3>> maps_;  ///< of each outline vertex
};

Points rectangle(double left, double right, double bottom, double top) {
  Points corners(2, 4);
  corners << left, right, right, left,  //
      bottom, bottom, top, top;
  return corners;
}

int main() {
  constexpr double young = 1e9, density = 2500, g = 10, width = 1, height = 4, slab_width = 3;
  const BlockMaterial rock{polyfem::elasticity_matrix(young, 0, Plane::strain), density};
  std::vector<std::unique_ptr<Block>> blocks;
  blocks.push_back(std::make_unique<VertexBlock>(rock, rectangle(-width / 2, width / 2, 0, height)));
  blocks.push_back(
      std::make_unique<RigidBlock>(density, rectangle(-slab_width / 2, slab_width / 2, height, height + 1)));
  const double slab_weight = blocks[1]->mass_total() * g, column_weight = blocks[0]->mass_total() * g;
  BlockSystem system(std::move(blocks));
  std::vector<PrescribedDof> held;  // both vertices of the column's base, in x and y
  for (int vertex = 0; vertex < 2; ++vertex)
    for (int axis = 0; axis < 2; ++axis) held.push_back({2 * vertex + axis, vertex, axis, {}});
  system.set_prescribed_dofs(held);

  const ContactProperties contacts{
      1e4 * young, 1e4 * young, JointTable(JointStrength{.friction = 0.5}), {0, 0}};
  AnalysisOptions analysis;
  analysis.gravity = Vec2(0, -g);
  analysis.mode = Mode::statics;
  analysis.scheme = Scheme::backward_euler;
  analysis.kinematics = Kinematics::incremental;
  analysis.time_step = 1;
  BlockState start = system.initial_state();
  const Points before = start.position;
  Stepper stepper(std::move(system), std::move(start), contacts, analysis);
  for (int k = 0; k < 5; ++k)
    if (!stepper.step()) throw Error(stepper.stop_reason());

  const Points change = before - stepper.state().position;
  const int first = stepper.blocks().block(1).vertices().first;
  const double exact = (slab_weight + column_weight / 2) * height / (young * width);
  std::cout << "settlement of the column " << change(1, 2) << " m, of the slab's corners "
            << change.row(1).segment(first, 4) << " m, expected " << exact << " m\n";
  const double error = (change.row(1).tail(6).array() / exact - 1).abs().maxCoeff();  // top and slab
  return error < 1e-4 ? 0 : 1;
}
