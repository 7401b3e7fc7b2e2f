/// \file The line of thrust through blocks.
#pragma once

#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/svg.hpp>
#include <ddacontact/picture/view.hpp>

#include <utility>
#include <vector>

namespace ddacontact {

/// What all contacts of two blocks come to. It acts on the joint where the normal forces have their centre.
struct JointResultant {
  int first = 0, second = 0;  ///< blocks, the smaller first
  Vec2 at{0, 0};              ///< m
  Vec2 force{0, 0};           ///< on the first, N per m
};
/// Of all pairs of blocks that press on each other, in the order of their numbers.
std::vector<JointResultant> joint_resultants(const Frame& frame);

/// Through each block that exactly two others load: from where one of the two resultants acts to where the
/// other does. Joints with less than 1e-6 of the largest resultant bear nothing.
std::vector<std::pair<Vec2, Vec2>> line_of_thrust(const Frame& frame);

/// The line in the places of a picture, with a square on each joint.
void draw_thrust(SvgPage& page, const View& view, const Frame& frame);
/// What the line means.
LegendItem thrust_explanation();

}  // namespace ddacontact
