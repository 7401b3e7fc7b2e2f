/// \file Blocks that are to be cut: those of a scene, or of a geometry file alone.
#pragma once

#include <ddacontact/scene/reader.hpp>

#include <string>

namespace ddacontact {

/// A scene to take blocks from.
struct BlocksReading {
  SceneReading scene;
  /// The first materials of the scene, which no block has by name: 1 for a geometry file, which says nothing
  /// of materials but their names, else 0.
  int n_unnamed_materials = 0;
};

/// Reads a scene (.toml), or a geometry file (.geojson, .json, .wkt, .dxf, .geo, .msh, .vtu) as the blocks of
/// a scene with 50 steps under gravity and materials of the same rock. Blocks of the model wachspress may be
/// concave.
/// `snap` > 0 counts before that of the scene. Never throws for a bad file.
BlocksReading read_blocks(const std::string& path, double snap = 0);

}  // namespace ddacontact
