/// \file A scene of stiff rock without blocks: what scenes for limit analysis begin with.
#pragma once

#include <ddacontact/scene/scene.hpp>

namespace support {

/// 2500 kg/m3, 35 GPa, one joint law without friction, every other option as a scene file has it by default.
inline ddacontact::Scene rigid_rock() {
  ddacontact::Scene scene;
  scene.analysis.max_displacement_ratio = 10;
  scene.materials = {{"rock", 2500, 35e9, 0.25}};
  scene.contact.normal_stiffness = 40 * scene.materials[0].young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  scene.joints.resize(1);
  scene.joints[0].name = "joint";
  return scene;
}

inline ddacontact::BlockDescription rock_block(const ddacontact::Points& outline, bool fixed = false) {
  ddacontact::BlockDescription block;
  block.vertices = outline;
  block.fixed = fixed;
  return block;
}

}  // namespace support
