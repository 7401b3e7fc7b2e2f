/// \file A first look at the forces in a scene, before its models are chosen.
#pragma once

#include <ddacontact/block/stress_moments.hpp>
#include <ddacontact/contact/contact_builder.hpp>

#include <vector>

namespace ddacontact {

/// How a scene stands under its loads at rest, to first order.
struct FirstLoading {
  bool settled = false;  ///< else nothing is known
  /// On each block, from its centroid: of contacts, loads and supports, gravity apart.
  std::vector<std::vector<ActingForce>> forces;
  /// Of each block: the moments about its centroid of its stress, and its mean stress.
  std::vector<StressMoments> moments;
  std::vector<Vec3> mean;
};

/// Contacts that touch at the start are closed where they press. They stick, all of them at first and then
/// those that press: with bounds of friction the solution takes ten times as long, and no longer converges in
/// walls of thousands of bricks. What nothing holds goes its way.
FirstLoading load_once(BlockSystem& blocks, const BlockState& initial, ContactBuilder& contacts);

}  // namespace ddacontact
