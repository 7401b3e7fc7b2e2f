/// \file Polygons of a GeoJSON text (RFC 7946) to blocks.
#pragma once

#include <ddacontact/scene/geometry_file.hpp>

#include <memory>
#include <string>

namespace ddacontact::scene_format {

/// A FeatureCollection, a Feature, or a Polygon, MultiPolygon or GeometryCollection on its own. Every polygon
/// is a block; a feature of another geometry is a problem and an invalid block, so that those after it keep
/// their index.
GeometryBlocks read_geojson(const std::string& text, const std::shared_ptr<const std::string>& source,
                            ProblemList& problems);

}  // namespace ddacontact::scene_format
