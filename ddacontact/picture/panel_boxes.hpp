/// \file Which part of its scene each panel shows, and how large.
#pragma once

#include <ddacontact/picture/view.hpp>

#include <algorithm>
#include <vector>

namespace ddacontact {

/// The parts of all panels.
struct PanelBoxes {
  std::vector<Window> boxes;  ///< of each panel
  bool same_scale = true;     ///< all panels show the same box; else each scene fills its panels as it can
  std::vector<Vec2> extents;  ///< sizes of the boxes, in units of `unit`

  /// m: the larger side of the box of a panel of its own scale, else 1.
  double unit(std::size_t panel) const {
    return same_scale ? 1 : std::max(boxes[panel].width(), boxes[panel].height());
  }
};

/// Panels of one scene get one box about all of `needed`. All get the same where that is at most twice as
/// large as what the smallest of the scenes needs.
PanelBoxes fit_boxes(const std::vector<Window>& needed, const std::vector<int>& scenes);

}  // namespace ddacontact
