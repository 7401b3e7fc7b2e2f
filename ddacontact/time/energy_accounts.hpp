/// \file The energies of a state and what a step did to them, each from its own definition.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/equations/step_system.hpp>
#include <ddacontact/time/energy_ledger.hpp>
#include <ddacontact/time/trial_step.hpp>

#include <vector>

namespace ddacontact {

/// Kinetic energy: v M v / 2 over all blocks, J per m.
double kinetic_energy(const BlockSystem& blocks, const VectorXd& velocity);

/// Energy in the springs of contacts at the end of their step, J per m.
double spring_energy(const std::vector<ContactRecord>& contacts, const ContactProperties& properties);

/// Elastic energy of the blocks, their contacts' springs, the springs of fixed vertices, and bolts, J per m.
double elastic_energy(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<ContactRecord>& contacts, const ContactProperties& properties);

/// Adds the step's work of supports, its friction, and what the scheme itself loses: it
/// takes every force at one value over the whole step, and the difference between that work and the change of
/// the energy that the force belongs to is gone. Of inertia's work the change of kinetic energy is still to
/// be taken off.
/// \param[in] motion    d and the shift that an impact made before: what forces act on
/// \param[in] contacts  at the end, with the overlaps that they started with
void account_step(const StepSystem& system, const TrialSolution& solution, const VectorXd& motion,
                  const std::vector<Contact>& contacts, const ContactProperties& properties, Energy& energy);

}  // namespace ddacontact
