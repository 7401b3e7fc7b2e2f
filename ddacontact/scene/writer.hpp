/// \file A scene back to TOML, with every default written out. Reading it again gives the same scene.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <iosfwd>

namespace ddacontact {

/// Writes a scene file that reads back as the same scene.
void write_scene(std::ostream& out, const Scene& scene);

}  // namespace ddacontact
