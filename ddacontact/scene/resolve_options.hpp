/// \file [analysis], also as stages change it, and [contact] of a scene file: defaults filled in, keys that
/// do not go together refused.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <vector>

namespace ddacontact::scene_format {

AnalysisOptions resolve_analysis(const AnalysisRecord& record, ProblemList& problems);
/// While a stage lasts. What is wrong with the scene's own is not said again.
AnalysisOptions resolve_analysis(const AnalysisRecord& of_scene, const StageRecord& stage,
                                 ProblemList& problems);
ContactOptions resolve_contact(const ContactRecord& record, Preset preset,
                               const std::vector<Material>& materials, ProblemList& problems);

}  // namespace ddacontact::scene_format
