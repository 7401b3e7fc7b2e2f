/// \file What a user has to be told of how a run went.
#pragma once

#include <ddacontact/time/stepper.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// When the last load, support or shaking stops changing, s.
double last_change(const BlockSystem& blocks);

/// Bonded contacts at the end that are pulled and bear more shear than c + sigma tan(phi), with the two
/// blocks that have most of them: cohesion acts whole until a bond breaks, which limit equilibrium does not
/// grant. Empty: there are none.
std::string describe_pulled_bonds(const Stepper& stepper);

/// A block of which a vertex has gone furthest, and how far in sizes of the block; -1 and 0: none has moved.
struct FurthestMove {
  int block = -1;
  double of_size = 0;
};

/// From where the blocks were drawn, or stood when displacements were reset.
FurthestMove furthest_move(const Stepper& stepper);

/// Warnings, a line each with its cure: stages whose `until` never came true, a last stage that is static and
/// ends out of balance, and what was seen on the way (RunWarnings).
/// \param[in] reasons  why each block has its model, empty where the scene says so; none: all say so. Whoever
///   asks for a mesh is told where it is too coarse.
std::vector<std::string> warnings_of(const Stepper& stepper, const std::vector<std::string>& reasons = {});

}  // namespace ddacontact
