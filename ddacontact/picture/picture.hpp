/// \file Pictures of frames: one panel or several, as SVG.
///
///     Frame frame = capture_frame(*built.stepper, built.labels, {});
///     std::string svg = draw({{.frame = &frame, .field = Field::s1, .caption = "after 300 steps"}}, {});
#pragma once

#include <ddacontact/core/water.hpp>
#include <ddacontact/picture/arrows.hpp>
#include <ddacontact/picture/bolt_layer.hpp>
#include <ddacontact/picture/colour_scale.hpp>
#include <ddacontact/picture/view.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// One picture of blocks on their deformed shape.
struct Panel {
  const Frame* frame = nullptr;  ///< must live as long as the drawing takes
  Field field = Field::none;
  std::string caption{};                   ///< above the blocks; may be empty
  std::vector<std::string> block_names{};  ///< for `names`; left out: indices
  int scene = 0;                           ///< panels of one scene are always drawn to one scale
  const Frame* values =
      nullptr;  ///< whose fields are shown, where `frame` is this one magnified; null: `frame`
  std::vector<BoltLine> bolts{};
  Water water{};  ///< at that moment

  const Frame& shown_values() const { return values ? *values : *frame; }
};

/// Which panels of a field have the same colours.
enum class RangeSharing { all, rows, none };

/// How panels are drawn, all alike.
struct PictureOptions {
  std::string title{};   ///< above everything; may be empty
  double width = 800;    ///< px; the picture may come out narrower
  double height = 1000;  ///< px; no panel is made so large that the picture is much higher
  int columns = 0;       ///< panels in a row; 0: as many as make the blocks largest
  RangeSharing sharing = RangeSharing::all;
  std::optional<ValueRange> range{};  ///< of the colours; left out: of the values shown
  std::optional<Window> window{};     ///< the part of the scene to show; left out: all of every panel
  bool reference = false;             ///< where the blocks were at the start, dashed
  bool names = false;                 ///< of the blocks, at their centroids
  bool thrust = false;                ///< the line of thrust, from joint to joint
  std::vector<VectorKind> vectors{};  ///< drawn on top, one after the other
};

/// The whole SVG file. All panels show the same part of the plane at the same scale, unless they are of
/// scenes that differ much in size; vectors of a kind have the same scale in all of them. Throws Error when
/// there is no panel or a frame does not hold what is asked.
std::string draw(const std::vector<Panel>& panels, const PictureOptions& options);

}  // namespace ddacontact
