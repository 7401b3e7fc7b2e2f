/// \file Polygons of well-known text to blocks.
#pragma once

#include <ddacontact/scene/geometry_file.hpp>

#include <memory>
#include <string>

namespace ddacontact::scene_format {

/// POLYGON, MULTIPOLYGON and GEOMETRYCOLLECTION, any number of them, in any number of lines; '#' starts a
/// comment. Every polygon is a block; a geometry of another kind is a problem and an invalid block, so that
/// those after it keep their index.
///
/// Not GEOS's reader: that reads one geometry of a string and tells no locations.
GeometryBlocks read_wkt(const std::string& text, const std::shared_ptr<const std::string>& source,
                        ProblemList& problems);

}  // namespace ddacontact::scene_format
