/// \file Drawings as blocks, and as what cuts a domain.
#pragma once

#include <ddacontact/scene/drawing.hpp>
#include <ddacontact/scene/geometry_file.hpp>

#include <string>

namespace ddacontact::scene_format {

/// Whether a path ends in .dxf or .geo.
bool is_drawing(const std::string& path);

/// Reads a drawing; its ending says what it is.
Drawing read_drawing(const std::string& path, const std::string& text, ProblemList& problems);

/// The closed lines of a drawing as blocks, each in a group called like its layer. Open lines are skipped,
/// with a warning.
GeometryBlocks blocks_of(const Drawing& drawing, const std::string& path, ProblemList& problems);

/// The closed line of the largest area; nothing and a problem where there is none.
const DrawnLine* boundary_of(const Drawing& drawing, const std::string& path, ProblemList& problems);

}  // namespace ddacontact::scene_format
