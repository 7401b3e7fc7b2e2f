/// \file Polygons as a file that other programs, or this one, can read.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// What a file of blocks may be.
enum class GeometryFormat {
  geojson,  ///< a FeatureCollection with a Polygon for each block
  wkt,      ///< a POLYGON a line
  dxf,      ///< a closed polyline for each block, on the layer of its first group
  toml      ///< a scene ready to run
};

/// Chosen by the ending of the path. Throws Error for an ending other than .geojson, .wkt, .dxf, .toml.
GeometryFormat geometry_format(const std::string& path);

/// Writes counter-clockwise polygons in their order; numbers read back to the same doubles.
///
/// The scene has one material, one joint and gravity; blocks that reach down to the lowest vertex of all are
/// held. An older file with another text gets a number; returns its new name. Throws Error as
/// `geometry_format` does and OutputError when the file cannot be written; the older one is as it was then.
std::optional<std::filesystem::path> write_geometry(const std::string& path,
                                                    const std::vector<Points>& polygons,
                                                    const std::string& title);

/// Writes the blocks of a scene: to .toml the whole scene, to .geojson features with `name`, `material`,
/// `model`, `group` and `fixed` where these are not what a feature without them has, to .wkt and .dxf the
/// polygons alone. The first `n_unnamed_materials` are not written to features. Keeps an older file and
/// throws as `write_geometry` does.
std::optional<std::filesystem::path> write_blocks(const std::string& path, const Scene& scene,
                                                  int n_unnamed_materials);

}  // namespace ddacontact
