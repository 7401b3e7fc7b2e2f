/// \file The cells of blocks of the model `mesh`.
#pragma once

#include <ddacontact/scene/outline_check.hpp>

#include <string>

namespace ddacontact::scene_format {

/// The options with those of a record in their place: `cells` takes the place of a cell size and the other
/// way round.
MeshOptions with_record(MeshOptions options, const MeshRecord& record);

/// Complains when the cells requested are too many, or are quads and the valid outline is not convex with
/// four corners. `of_all` is what the analysis says, for the
/// locations of keys that the block has not.
void check_mesh(const CheckedOutline& outline, const MeshOptions& options, const BlockRecord& block,
                const MeshRecord& of_all, const std::string& title, ProblemList& problems);

}  // namespace ddacontact::scene_format
