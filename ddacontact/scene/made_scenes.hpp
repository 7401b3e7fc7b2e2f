/// \file Scenes to start from, as text to run and to edit. Lengths in m, angles in degrees.
#pragma once

#include <string>

namespace ddacontact {

/// A rock slope with bedding that dips out of its face and cross joints.
struct MadeSlope {
  double height = 20, face = 60;  ///< of the face above the toe; its angle
  double dip = 25, spacing = 3;   ///< of the bedding
  int seed = 1;
};

/// A tunnel in rock with two joint sets.
struct MadeTunnel {
  double width = 6, height = 6, spacing = 3;
  int seed = 1;
};

/// A wall of bricks with a door under a lintel.
struct MadeWall {
  double length = 6, height = 3;
  double brick_length = 0.5, brick_height = 0.25;
  double door_width = 1.25, door_height = 1.75;  ///< width 0: no door
  bool running_bond = true;                      ///< false: stack bond
};

/// A semicircular arch between springers.
struct MadeArch {
  double span = 8, thickness = 1;  ///< clear span
  int voussoirs = 15;
  bool fill = false;  ///< soil above, between abutments
};

/// A column of drums.
struct MadeColumn {
  double diameter = 1, drum = 0.8;  ///< height of a drum
  int drums = 8;
};

/// Irregular blocks that fall into a bin.
struct MadeHeap {
  double size = 0.5;  ///< of a block
  int blocks = 60;
  int seed = 1;
};

/// More blocks would not be of use to start from.
inline constexpr double most_made_blocks = 1e6;

// Each throws Error for measures of which no scene, or one of more blocks, would come.

/// A slope as the text of a scene file.
std::string made_scene(const MadeSlope& options);
/// A tunnel as the text of a scene file.
std::string made_scene(const MadeTunnel& options);
/// A wall as the text of a scene file.
std::string made_scene(const MadeWall& options);
/// An arch as the text of a scene file.
std::string made_scene(const MadeArch& options);
/// A column as the text of a scene file.
std::string made_scene(const MadeColumn& options);
/// A heap as the text of a scene file.
std::string made_scene(const MadeHeap& options);

}  // namespace ddacontact
