/// \file [water] of a scene file, and what stages change of it.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// [water]; no water without it.
Water resolve_water(const Document& document, ProblemList& problems);

/// The same with what a stage changes of it.
Water changed_water(const StageRecord& stage, const Document& document, const AnalysisOptions& analysis,
                    ProblemList& problems);

}  // namespace ddacontact::scene_format
