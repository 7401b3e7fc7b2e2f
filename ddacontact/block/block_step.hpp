/// \file THE interface: a step of one block, how it goes on and with what forces it resists.
#pragma once

#include <ddacontact/block/state.hpp>
#include <ddacontact/block/step_start.hpp>

#include <span>

namespace ddacontact {

class BlockMotion;

/// A step of a block that was begun (Block::begin_step): the functions of its displacements d from there.
/// Vectors are in the order of the block's own unknowns. Forces are per metre of thickness.
class BlockStep {
 public:
  virtual ~BlockStep() = default;

  /// Writes the displacements of a step without forces: where to look for those with them.
  virtual void free_path(VectorOut path) const = 0;
  /// The forces that resist displacements d of the block's unknowns.
  virtual void forces(const VectorIn& d, BlockForces& forces) const = 0;
  /// The matrices of all parts (Block::n_parts) of the tangent: the derivative of the forces by d, next to
  /// exact, symmetric positive definite.
  virtual void tangent(const VectorIn& d, std::span<MatrixXd> parts) const = 0;
  /// d += change, where the block's frame turns with it the rotation in `change` carried out as one:
  /// rotations that are added up stretch the block.
  virtual void add_change(const VectorIn& change, VectorOut d) const { d += change; }
  /// Writes into `next`, which holds those before the step, the block's positions, velocity, what the scheme
  /// carries on and stress after it; with half steps the velocity is left as it is. `external` are all forces
  /// that acted on it: free blocks take their momentum from them (and with forces at the middle their angular
  /// momentum).
  virtual void end(const VectorIn& d, const VectorIn& external, bool is_free, BlockState& next) const = 0;
  /// Displacements that the block's unknowns have after d. With half steps d is the straight motion of the
  /// shape at the start, dt times its velocities: forces act on that, and the block turns on the way.
  virtual void displacement(const VectorIn& d, VectorOut displaced) const { displaced = d; }
  /// The step itself where the block is carried on by its motions, else null.
  virtual const BlockMotion* motion() const { return nullptr; }

  /// Energy that displacements d store in the block, J per m.
  virtual double stored_energy(const VectorIn& d) const = 0;
  /// Work of the block's elastic forces that the step loses, J per m: by the identity of the scheme where
  /// there is one, so that a force that is not that of the energy leaves the ledger open; else the work of
  /// `elastic` less the energy stored.
  virtual double elastic_loss(const VectorIn& d, const VectorIn& elastic) const {
    return d.dot(elastic) - stored_energy(d);
  }
};

}  // namespace ddacontact
