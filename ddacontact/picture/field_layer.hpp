/// \file A field of numbers in colours, smooth inside each cell of a block.
#pragma once

#include <ddacontact/output/cell_pieces.hpp>
#include <ddacontact/picture/colour_scale.hpp>
#include <ddacontact/picture/fan_mesh.hpp>
#include <ddacontact/picture/view.hpp>

#include <vector>

namespace ddacontact {

/// A field of a frame at the nodes of a triangulation of every cell, fine enough for a scale.
class FieldSamples {
 public:
  /// \param[in] pixels_per_metre  the scale at which the field will be drawn; may be a little too large
  FieldSamples(const Frame& frame, Field field, double pixels_per_metre)
      : FieldSamples(frame, field, pixels_per_metre, frame) {}
  /// The same, drawn at the points of another frame of the same blocks, which is kept by reference.
  FieldSamples(const Frame& frame, Field field, double pixels_per_metre, const Frame& drawn);

  /// Of all nodes; {0, 0} when there are none.
  const ValueRange& range() const { return range_; }
  /// What colours should tell apart: of divided blocks without the outer halves of the cells, whose functions
  /// have steep gradients at short edges and nearly straight corners that mean nothing; where peaks of
  /// stress take more than half as much again, from the 1st to the 99th percentile by area.
  const ValueRange& telling_range() const { return telling_range_; }
  /// Whether it is that of the percentiles.
  bool has_peaks() const { return has_peaks_; }

  /// Nested regions, painted from the lowest colour to the highest, one path for each colour: what is higher
  /// lies on what is lower, so no gap shows between them.
  void draw(SvgPage& page, const View& view, const ColourScale& scale) const;

 private:
  /// A part of a cell with its triangulation.
  struct Piece {
    int cell;
    CellPiece corners;  ///< of the cell
    FanMesh mesh;
    Points nodes;  ///< where they are drawn, relative to the cell's first corner
    VectorXd values;
  };

  ValueRange percentiles(Field field, const std::vector<bool>& is_divided) const;
  void add_piece(const Piece& piece, int ground, const View& view, const ColourScale& scale,
                 std::vector<PathData>& paths) const;
  std::vector<int> grounds(const ColourScale& scale) const;

  const Frame& frame_;  ///< that is drawn
  std::vector<Piece> pieces_;
  ValueRange range_, telling_range_;
  bool has_peaks_ = false;
};

}  // namespace ddacontact
