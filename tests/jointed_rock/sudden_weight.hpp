/// \file Blocks let go under their own weight: whether they move.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace jointed_rock {

using namespace ddacontact;

enum class Verdict { moves, creeps, rests, stops };
std::string name_of(Verdict verdict);

/// What became of a scene after at most `watched` seconds.
struct Outcome {
  Verdict verdict = Verdict::stops;
  double time = 0;               ///< s
  double displacement = 0;       ///< largest of a free block's vertices, m
  double part = 0;               ///< displacement over acceleration time^2 / 2
  std::vector<Points> vertices;  ///< displacements, block by block
  std::string stopped_by;        ///< of Verdict::stops: why
};

constexpr double watched = 1;       // s
constexpr double time_step = 0.01;  // s
/// At least this part of the displacement that the expected acceleration gives: the blocks move. Less than a
/// tenth of it: they rest.
constexpr double moving_part = 0.1;

/// Runs the scene from rest with the same friction everywhere until a vertex has come as far as
/// `acceleration` takes it in the time watched, or the time is over. The scene's steps and friction do not
/// count.
Outcome let_go(Scene scene, double friction, double acceleration);

}  // namespace jointed_rock
