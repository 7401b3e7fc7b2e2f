/// \file A scene back to the tables of a scene file, every default written out.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// The inverse of `resolve`.
Document document_of(const Scene& scene);

}  // namespace ddacontact::scene_format
