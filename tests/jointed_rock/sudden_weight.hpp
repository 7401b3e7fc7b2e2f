/// \file Blocks let go under their own weight: whether they move.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace jointed_rock {

using namespace ddacontact;

enum class Verdict { moves, creeps, rests, stops };
std::string name_of(Verdict verdict);

/// What became of a scene.
struct Outcome {
  Verdict verdict = Verdict::stops;
  double time = 0;               ///< s, when the run ended
  double displacement = 0;       ///< largest of a vertex, m
  double part = 0;               ///< displacement over acceleration time^2 / 2; 0: stopped at once
  std::vector<Points> vertices;  ///< displacements, block by block
};

constexpr double watched = 1;       ///< s, at most
constexpr double time_step = 0.01;  ///< s
/// Blocks move once a vertex has come this part of acceleration watched^2 / 2; they rest when it is less than
/// a tenth of it in the end.
constexpr double moving_part = 0.1;

/// Runs the scene from rest with the same friction everywhere until a vertex has come `enough` of
/// acceleration watched^2 / 2, or the time is over. The scene's steps and friction do not count.
Outcome let_go(Scene scene, double friction, double acceleration, double enough = moving_part);

}  // namespace jointed_rock
