/// \file Lines of a drawing.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// A line through points.
struct DrawnLine {
  Points points;
  bool closed = false;  ///< from the last point back to the first
  std::string layer;
  SourceLocation location;
};

struct Drawing {
  std::vector<DrawnLine> lines;
  bool complete = false;  ///< read to its end
};

/// A DXF text: LINE, LWPOLYLINE, POLYLINE, CIRCLE and ARC of its entities; arcs are chords of at most 15
/// degrees. A polyline whose last point is its first is closed. Others are skipped, with one warning.
///
/// Not by libdxflib: that tells no lines for messages, and takes what is no number as 0.
Drawing read_dxf(const std::string& text, const std::shared_ptr<const std::string>& source,
                 ProblemList& problems);

/// The geometry file of Shi's DC: counts, then lines "x1 y1 x2 y2 n". The boundary lines, which come first,
/// are chained to closed lines on the layer "boundary"; a joint of type n is on the layer "n". Lines of
/// materials and points are skipped, with one warning.
Drawing read_shi_geometry(const std::string& text, const std::shared_ptr<const std::string>& source,
                          ProblemList& problems);

}  // namespace ddacontact::scene_format
