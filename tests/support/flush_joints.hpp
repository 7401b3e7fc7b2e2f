/// \file Blocks that slide over joints: rows of bricks with level tops, planes of several blocks' edges, a
/// shaft as wide as what stands over it. One block slides or falls, the last of the scene; its answer is that
/// of a single block on a single face.
#pragma once

#include <ddacontact/scene/builder.hpp>

namespace support {

/// Rock of 2500 kg/m3 between joints of this friction, gravity 9.8 m/s2, default mechanics.
struct JointedBlocks {
  double young = 35e9;        ///< Pa
  double friction_angle = 0;  ///< degrees
  double time_step = 0.01;    ///< s
  double duration = 0.5;      ///< s
  ddacontact::BlockModel model = ddacontact::BlockModel::automatic;
};

/// A row of bricks of 0.5 m x 0.5 m, and a block of 1 m x 0.5 m sliding over their tops to the right.
struct BrickRow {
  int n_bricks = 10;
  double gap = 0;      ///< m, between bricks
  double step_up = 0;  ///< m, by which the sixth brick and all after it are higher
  bool free = false;   ///< on a fixed base, on which they do not slide (45 degrees); else fixed themselves
  double start = 0.2;  ///< m, where the block's left side starts
  double speed = 3;    ///< m/s
};
ddacontact::Scene sliding_over_bricks(const BrickRow& row, const JointedBlocks& blocks);

/// A plane whose edge belongs to three fixed blocks, and one or more blocks of 1 m x 0.3 m on it, at rest.
/// The joints between the three cross the plane.
struct CrossedPlane {
  double dip = 45;             ///< degrees
  double crossing_angle = 90;  ///< of the joints against the plane, degrees
  double corner = 0;           ///< m, how far the front corner is beyond the first crossing
  int n_blocks = 1;
};
ddacontact::Scene on_a_crossed_plane(const CrossedPlane& plane, const JointedBlocks& blocks);

/// A block of 1 m x 0.5 m over the mouth of a shaft that is wider by `clearance` (m).
ddacontact::Scene over_a_shaft(double clearance, const JointedBlocks& blocks);

/// Speed of a block along `direction`, m/s, at the end of a run; throws Error when it stops.
double final_speed(const ddacontact::Scene& scene, int block, const ddacontact::Vec2& direction);

}  // namespace support
