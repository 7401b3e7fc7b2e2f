/// \file Scenes made to be hard on contacts, each in its own way.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace support {

/// 30 blocks with large initial velocities, breaking bonds, stiffness and mass ratios of 1e6, friction next
/// to its limit, corners on corners, rolling, fast spinning, static steps; with names.
std::vector<std::pair<std::string, ddacontact::Scene>> made_scenes();

}  // namespace support
