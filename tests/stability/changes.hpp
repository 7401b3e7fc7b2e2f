/// \file Scenes run as they are and stated otherwise, and how far apart that leaves them.
#pragma once

#include "scenes.hpp"

#include <functional>

namespace stability {

/// A statement of the same scene, and how its run reads in the terms of the first one.
struct Restatement {
  std::string name;
  std::function<Scene(const Scene&)> restated;
  std::function<Run(Run)> read_back;
};

/// By powers of two, of lengths, masses, times and of all of them.
std::vector<Restatement> binary_units();
/// By 1e6 and 1e-6, of each and of all of them.
std::vector<Restatement> decimal_units();
/// Turned by quarters and other angles, mirrored; vertices from another one on and the other way round;
/// blocks in the opposite order and in a random one.
std::vector<Restatement> other_views();

/// A scene against its restatements.
struct Agreement {
  std::string scene;
  double apart = 0;   ///< the largest distance between displacements, over the smallest free block
  std::string worst;  ///< the restatement that has it
  double shaken = 0;  ///< the same when every coordinate's last digit is changed by lot
  bool same_counts = true;

  /// The last digits of its coordinates decide what happens: touching corners and sides do not say which of
  /// them bear, or the scene is chaotic.
  bool hangs_on_last_digits() const { return shaken > 1e-11; }
};
Agreement compare(const NamedScene& named, const std::vector<Restatement>& restatements, int steps);

/// Whether everything is the same to the bit.
bool same_bits(const Run& one, const Run& other);

}  // namespace stability
