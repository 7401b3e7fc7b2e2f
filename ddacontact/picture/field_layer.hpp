/// \file A field of numbers in colours, smooth inside each block.
#pragma once

#include <ddacontact/picture/colour_scale.hpp>
#include <ddacontact/picture/fan_mesh.hpp>
#include <ddacontact/picture/view.hpp>

namespace ddacontact {

/// A field of a frame at the nodes of a triangulation of every block, fine enough for a scale.
class FieldSamples {
 public:
  /// \param[in] pixels_per_metre  the scale at which the field will be drawn; may be a little too large
  FieldSamples(const Frame& frame, Field field, double pixels_per_metre);

  /// Of all nodes; {0, 0} when there are none.
  const ValueRange& range() const { return range_; }

  /// Nested regions, painted from the lowest colour to the highest, one path for each colour: what is higher
  /// lies on what is lower, so no gap shows between them.
  void draw(SvgPage& page, const View& view, const ColourScale& scale) const;

 private:
  void add_block(int block, const View& view, const ColourScale& scale, std::vector<PathData>& paths) const;

  const Frame& frame_;
  std::vector<FanMesh> meshes_;
  std::vector<Vec2> centroids_;  ///< relative to the outline's first vertex
  std::vector<VectorXd> values_;
  ValueRange range_;
};

}  // namespace ddacontact
