/// \file A field of numbers in colours, smooth inside each cell of a block.
#pragma once

#include <ddacontact/output/cell_pieces.hpp>
#include <ddacontact/picture/colour_scale.hpp>
#include <ddacontact/picture/fan_mesh.hpp>
#include <ddacontact/picture/view.hpp>

namespace ddacontact {

/// A field of a frame at the nodes of a triangulation of every cell, fine enough for a scale.
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
  /// A part of a cell with its triangulation.
  struct Piece {
    int cell;
    CellPiece corners;  ///< of the cell
    FanMesh mesh;
    Points nodes;  ///< relative to the cell's first corner
    VectorXd values;
  };

  void add_piece(const Piece& piece, int ground, const View& view, const ColourScale& scale,
                 std::vector<PathData>& paths) const;
  std::vector<int> grounds(const ColourScale& scale) const;

  const Frame& frame_;
  std::vector<Piece> pieces_;
  ValueRange range_;
};

}  // namespace ddacontact
