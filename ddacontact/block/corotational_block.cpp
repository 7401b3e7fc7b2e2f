#include <ddacontact/block/corotational_block.hpp>

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/block/corotational_step.hpp>
#include <ddacontact/block/stress_projection.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace ddacontact {

namespace {

/// Stress in axes turned by R: R sigma R^T.
Vec3 turned(const Mat2& R, const Vec3& stress) {
  Mat2 sigma;
  sigma << stress[0], stress[2], stress[2], stress[1];
  sigma = (R * sigma * R.transpose()).eval();
  return {sigma(0, 0), sigma(1, 1), sigma(0, 1)};
}

}  // namespace

Points CorotationalBlock::nodes(const BlockState& state) const {
  return NodalKinematics<polyfem::AnyNodes>(*shape_).of_points(points().columns_of(state.position));
}

PointMap CorotationalBlock::vertex_map(int point) const {
  return shape_->point_maps.empty() ? PointMap(unknowns().first + 2 * point)
                                    : PointMap(unknowns().first, shape_->point_maps[point]);
}

MatrixXd CorotationalBlock::times_mass(const Eigen::Ref<const MatrixXd>& velocities) const {
  MatrixXd momenta(n_unknowns(), velocities.cols());
  with_nodes(*shape_, [&](const auto& nodes) {
    for (Index k = 0; k < velocities.cols(); ++k)
      nodes.forces_on_unknowns(nodes.weighted(nodes.to_nodes(velocities.col(k))), momenta.col(k));
  });
  return momenta;
}

double CorotationalBlock::kinetic_energy(const VectorIn& velocity) const {
  return with_nodes(*shape_, [&](const auto& nodes) {
    const auto v = nodes.to_nodes(velocity);
    return nodes.weighted(v).cwiseProduct(v).sum() / 2;
  });
}

void CorotationalBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    typename Of::Stacked forces(n_unknowns());
    nodes.forces_on_unknowns(nodes.weight(b / material().density), forces);
    unknowns().of(F) += forces;
  });
}

void CorotationalBlock::rotation(const BlockState& state, Eigen::Ref<VectorXd> unknowns) const {
  with_nodes(*shape_, [&](const auto& nodes) {
    nodes.to_unknowns(nodes.spin(nodes.of_points(points().columns_of(state.position))), unknowns);
  });
}

TensorsRef CorotationalBlock::initial_stress(const BlockState& state) const {
  if (state.stress.cols() == 0) return state.stress;
  return stress_points().columns_of(state.stress);
}

CorotationalBlock::Frame CorotationalBlock::cell_frame(const BlockState& state, const Points& y,
                                                       int c) const {
  if (state.coordinates.size() == 0)
    return NodalKinematics<polyfem::AnyNodes>(*shape_).frame(y, static_cast<std::size_t>(c));
  // That of the motions, in which forces were balanced.
  const auto s = coordinates().of(state.coordinates);
  const Points u = s.tail(shape_->nodes.size()).reshaped(2, shape_->nodes.cols());
  const std::vector<int>& nodes = shape_->cells[c].nodes;
  Frame frame;
  frame.rotation = turned_by(s[2]);
  frame.u = nodes.empty() ? VectorXd(u.reshaped()) : VectorXd(Points(u(Eigen::all, nodes)).reshaped());
  return frame;
}

TensorsRef CorotationalBlock::initial_stress(const BlockState& state, int c) const {
  if (state.stress.cols() == 0) return state.stress;
  const ShapeCell& cell = shape_->cells[c];
  return state.stress.middleCols(stress_points().first + cell.first_point, cell.element.n_points());
}

double CorotationalBlock::elastic_energy_of_deformation(const BlockState& state) const {
  const auto u = coordinates().of(state.coordinates).tail(shape_->nodes.size());
  double energy = 0;
  if (!u.isZero(0))
    energy = with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>&) {
      const typename Of::Stacked of_nodes = u;
      if (shape_->is_one_cell())
        return shape_->cells[0].elastic.template times_stiffness<Of>(of_nodes).dot(of_nodes) / 2;
      return u.dot(shape_->motions().stiffness * u) / 2;
    });
  const TensorsRef initial = initial_stress(state);
  if (initial.isZero(0)) return energy;
  energy += initial_force(state).dot(u);
  for (Index p = 0; p < initial.cols(); ++p)
    energy += shape_->integration_weights[p] * initial.col(p).dot(compliance() * initial.col(p)) / 2;
  return energy;
}

VectorXd CorotationalBlock::initial_force(const BlockState& state) const {
  if (initial_stress(state).isZero(0)) return {};
  const NodalKinematics<polyfem::AnyNodes> nodes(*shape_);
  Points force = Points::Zero(2, shape_->nodes.cols());
  for (int c = 0; c < n_cells(); ++c) {
    VectorXd of_cell(2 * shape_->cells[c].elastic.n_nodes());
    polyfem::stress_forces(shape_->cells[c].element, initial_stress(state, c), of_cell);
    nodes.add_of_cell(of_cell, static_cast<std::size_t>(c), force);
  }
  return force.reshaped();
}

double CorotationalBlock::elastic_energy(const BlockState& state) const {
  if (state.coordinates.size() > 0) return elastic_energy_of_deformation(state);
  return with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    const auto y = nodes.of_points(points().columns_of(state.position));
    double energy = 0;
    for (int c = 0; c < n_cells(); ++c) {
      const ShapeCell& cell = shape_->cells[c];
      const TensorsRef initial = initial_stress(state, c);
      typename Of::Stacked force = Of::Stacked::Zero(2 * cell.elastic.n_nodes());
      if (!initial.isZero(0)) {
        polyfem::stress_forces(cell.element, initial, force);
        for (Index q = 0; q < initial.cols(); ++q)
          energy += cell.element.rule.weights[q] * initial.col(q).dot(compliance() * initial.col(q)) / 2;
      }
      energy += cell.elastic.energy(nodes.frame(y, static_cast<std::size_t>(c)), force);
    }
    return energy;
  });
}

Tensors CorotationalBlock::cell_stresses(const BlockState& state, const Frame& frame, int c) const {
  const ShapeCell& cell = shape_->cells[c];
  Tensors stress;
  if (cell.mean_dilatation) {
    polyfem::b_bar_stresses(cell.element, material().elasticity, frame.u, stress);
  } else {
    Tensors strain;
    polyfem::strains(cell.element, frame.u, strain);
    stress = material().elasticity * strain;
  }
  const TensorsRef initial = initial_stress(state, c);
  if (initial.cols() == 0) return Tensors::Zero(stress.rows(), stress.cols()) + stress;
  return initial + stress;
}

Tensors CorotationalBlock::stress(const BlockState& state) const {
  const Points y = nodes(state);
  Tensors sigma(Tensors::RowsAtCompileTime, n_stress_points());
  for (int c = 0; c < n_cells(); ++c) {
    const Frame frame = cell_frame(state, y, c);
    const Tensors of_cell = cell_stresses(state, frame, c);
    for (Index q = 0; q < of_cell.cols(); ++q)
      sigma.col(shape_->cells[c].first_point + q) = turned(frame.rotation, of_cell.col(q));
  }
  return sigma;
}

Points CorotationalBlock::integration_points() const {
  Points points(2, n_stress_points());
  for (int c = 0; c < n_cells(); ++c)
    points.middleCols(shape_->cells[c].first_point, shape_->cells[c].element.n_points()) =
        shape_->cells[c].element.rule.points;
  return points;
}

BlockCell CorotationalBlock::cell(int c) const {
  const ShapeCell& of = shape_->cells[c];
  BlockCell cell = Block::cell(c);
  if (!of.nodes.empty()) cell.corners = of.nodes;
  cell.basis = of.basis;
  return cell;
}

CellStress CorotationalBlock::cell_stress(const BlockState& state, int c) const {
  if (shape_->is_one_cell()) return Block::cell_stress(state, c);
  const ShapeCell& cell = shape_->cells[c];
  const Frame frame = cell_frame(state, nodes(state), c);
  CellStress stress{frame.rotation * frame.u.reshaped(2, cell.elastic.n_nodes()), material().elasticity,
                    Vec3::Zero()};
  if (cell.mean_dilatation) stress.elasticity.topLeftCorner<2, 2>().array() -= material().elasticity(0, 1);
  // What the strains at the points do not carry is the same at all of them.
  Tensors strain;
  polyfem::strains(cell.element, frame.u, strain);
  const Tensors rest = cell_stresses(state, frame, c) - stress.elasticity * strain;
  stress.offset = turned(frame.rotation, rest.rowwise().mean());
  return stress;
}

Points CorotationalBlock::strain_displacement(const BlockState& state) const {
  assert(shape_->is_one_cell());
  const ShapeCell& cell = shape_->cells[0];
  const Frame frame = cell_frame(state, nodes(state), 0);
  const Points u = frame.u.reshaped(2, shape_->nodes.cols());
  Points w = u, rest = shape_->nodes;
  if (shape_->points.size() > 0) {
    w = u * shape_->points.transpose();
    rest = shape_->nodes * shape_->points.transpose();
  }
  const Tensors initial = initial_stress(state, 0);
  if (initial.isZero(0)) return frame.rotation * w;
  if (cell.element.n_points() == 1)
    w += uniform_strain_displacement(rest, Vec2::Zero(), compliance() * initial.col(0));
  else
    w += stress_projection(cell.element, cell.elastic.stiffness(), rest, initial, *cell.basis);
  return frame.rotation * w;
}

template <class Step>
Step& CorotationalBlock::renew(std::unique_ptr<BlockStep>& step) const {
  if (!dynamic_cast<Step*>(step.get())) step = std::make_unique<Step>(*this, *shape_);
  return static_cast<Step&>(*step);
}

void CorotationalBlock::begin_step(const BlockState& state, const StepStart& start,
                                   std::unique_ptr<BlockStep>& step) const {
  const Range& u = unknowns();
  assert(start.dt > 0 && start.velocity.size() >= u.end());
  StepRule rule = start.rule;
  if (rule.is_explicit() && start.dt > longest_explicit_step(*shape_, rule.damping))
    rule.scheme = Scheme::decaying;
  if (rule.has_half_steps()) {
    renew<BlockMotion>(step).begin(rule, start.dt, coordinates().of(state.coordinates), u.of(start.velocity),
                                   initial_force(state));
    return;
  }
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    renew<CorotationalStep<Of>>(step).begin(rule, start.dt,
                                            nodes.of_points(points().columns_of(state.position)),
                                            nodes.to_nodes(u.of(start.velocity)),
                                            nodes.to_nodes(u.of(start.acceleration)), initial_stress(state));
  });
}

}  // namespace ddacontact
