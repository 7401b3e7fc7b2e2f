/// \file Motions of the nodes of a corotational block, and what is rigid in them.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <vector>

namespace ddacontact {

/// The nodes of a shape as arrays of a known size (polyfem::Nodal) and their mass.
template <class Of>
class NodalKinematics {
 public:
  using Vectors = typename Of::Vectors;
  using Stacked = typename Of::Stacked;

  explicit NodalKinematics(const CorotationalShape& shape) : shape_(shape) {}

  const CorotationalShape& shape() const { return shape_; }
  Index n_nodes() const { return shape_.nodes.cols(); }

  /// Changes or velocities of the nodes, 2 x m, by those of the unknowns, and back.
  [[gnu::always_inline]] Vectors to_nodes(const VectorIn& d) const {
    if (!shape_.has_basis()) return Eigen::Map<const Vectors>(d.data(), 2, n_nodes());
    return Stacked(shape_.basis * d).reshaped(2, n_nodes());
  }
  void to_unknowns(const Vectors& changes, VectorOut d) const {
    if (!shape_.has_basis())
      Eigen::Map<Vectors>(d.data(), 2, n_nodes()) = changes;
    else
      d = shape_.inverse_basis * Stacked(changes.reshaped());
  }
  void forces_on_unknowns(const Vectors& on_nodes, VectorOut f) const {
    if (!shape_.has_basis())
      Eigen::Map<Vectors>(f.data(), 2, n_nodes()) = on_nodes;
    else
      f = shape_.basis.transpose() * Stacked(on_nodes.reshaped());
  }
  /// The work of forces of the unknowns on a motion of the nodes.
  double work(const VectorIn& forces, const Vectors& motion) const {
    if (!shape_.has_basis())
      return Eigen::Map<const Vectors>(forces.data(), 2, n_nodes()).cwiseProduct(motion).sum();
    return forces.dot(shape_.inverse_basis * Stacked(motion.reshaped()));
  }

  /// The nodes by the points, and back.
  Vectors of_points(const PointsRef& points) const {
    if (shape_.points.size() == 0) return points;
    return points * shape_.nodes_of_points.transpose();
  }
  void put_points(const Vectors& y, Eigen::Ref<Points> points) const {
    if (shape_.points.size() == 0)
      points = y;
    else
      points.noalias() = y * shape_.points.transpose();
  }

  /// v M
  [[gnu::always_inline]] Vectors weighted(const Vectors& v) const {
    if (!shape_.is_one_cell()) return v * shape_.mass;
    const MatrixXd& M = shape_.cells[0].mass;
    Vectors momenta = Vectors::Zero(2, v.cols());
    for (Index a = 0; a < v.cols(); ++a)
      momenta += v.col(a) * Eigen::Map<const typename Of::Scalars>(M.col(a).data(), v.cols()).transpose();
    return momenta;
  }
  /// The forces on the nodes of an acceleration of all points.
  Vectors weight(const Vec2& acceleration) const { return acceleration * mass_of_translation().transpose(); }
  /// v M t / t M t
  [[gnu::always_inline]] Vec2 mean(const Vectors& v) const {
    return v.lazyProduct(mass_of_translation()) / shape_.mass_total;
  }
  /// Nodal values of a vector that is the same for all points of the block.
  [[gnu::always_inline]] Vectors everywhere(const Vec2& v) const {
    return v * Eigen::Map<const typename Of::Scalars>(shape_.translation.data(), n_nodes()).transpose();
  }
  /// Arms of the nodes from the centre of mass.
  [[gnu::always_inline]] Vectors arms(const Vectors& y) const { return y - everywhere(mean(y)); }
  /// Velocities of a unit rotation about the centre of mass.
  [[gnu::always_inline]] Vectors spin(const Vectors& y) const { return left(arms(y)); }

  /// Rigid part of velocities of the nodes at y: momentum over mass, angular momentum over inertia.
  struct Rigid {
    Vec2 linear;
    double angular, inertia;
    Vectors turning;  ///< velocities of a unit rotation
  };
  Rigid rigid(const Vectors& y, const Vectors& velocity) const {
    Rigid rigid;
    rigid.linear = mean(velocity);
    rigid.turning = spin(y);
    const Vectors momenta = weighted(rigid.turning);
    rigid.inertia = momenta.cwiseProduct(rigid.turning).sum();
    rigid.angular = momenta.cwiseProduct(velocity).sum() / rigid.inertia;
    return rigid;
  }
  /// Adds the forces on the nodes of a cell.
  void add_of_cell(const Stacked& f, std::size_t c, Vectors& on_nodes) const {
    const std::vector<int>& nodes = shape_.cells[c].nodes;
    if (nodes.empty()) {
      on_nodes += f.reshaped(2, n_nodes());
      return;
    }
    for (std::size_t k = 0; k < nodes.size(); ++k)
      on_nodes.col(nodes[k]) += f.template segment<2>(2 * static_cast<Index>(k));
  }
  Vectors of_cell(const ShapeCell& cell, const Vectors& y) const {
    return cell.nodes.empty() ? y : Vectors(y(Eigen::all, cell.nodes));
  }
  polyfem::CorotatedFrameOf<Of> frame(const Vectors& y, std::size_t c) const {
    const ShapeCell& cell = shape_.cells[c];
    polyfem::CorotatedFrameOf<Of> frame;
    cell.elastic.frame(of_cell(cell, y), frame);
    return frame;
  }
  /// Rotation of the cell's frame.
  Mat2 cell_rotation(const Vectors& y, std::size_t c) const {
    return shape_.cells[c].elastic.template rotation<Of>(of_cell(shape_.cells[c], y));
  }

 private:
  Eigen::Map<const typename Of::Scalars> mass_of_translation() const {
    return {shape_.mass_of_translation.data(), n_nodes()};
  }

  const CorotationalShape& shape_;
};

/// Calls work(NodalKinematics<Of>(shape)) with arrays that live without the heap where the nodes are few.
template <class Work>
decltype(auto) with_nodes(const CorotationalShape& shape, Work&& work) {
  if (shape.is_one_cell() && shape.nodes.cols() == polyfem::FourNodes::Vectors::ColsAtCompileTime)
    return work(NodalKinematics<polyfem::FourNodes>(shape));
  if (shape.is_one_cell() && shape.nodes.cols() <= polyfem::FewNodes::Vectors::MaxColsAtCompileTime)
    return work(NodalKinematics<polyfem::FewNodes>(shape));
  return work(NodalKinematics<polyfem::AnyNodes>(shape));
}

}  // namespace ddacontact
