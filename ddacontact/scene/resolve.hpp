/// \file The tables of a scene file to a scene: names to indices, defaults filled in, everything checked.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// What is wrong goes to `problems`; the scene is good when there is no error among them.
Scene resolve(const Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
