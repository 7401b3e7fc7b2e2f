/// \file What the tables of a result tell: models of blocks, motion, stress, contacts, reactions, frames and
/// files.
///
/// All throw ddacontact::Error when a table is missing or damaged.
#pragma once

#include "answer.hpp"

#include <ddacontact/output/summary_reader.hpp>
#include <ddacontact/scene/scene.hpp>

#include <filesystem>
#include <optional>

namespace dda {

void tell_models(Answer& answer, const std::filesystem::path& directory);
void tell_motion(Answer& answer, const std::filesystem::path& directory);
void tell_stress(Answer& answer, const std::filesystem::path& directory);
void tell_contacts(Answer& answer, const ddacontact::SummaryTable& summary,
                   const std::filesystem::path& directory);
void tell_reactions(Answer& answer, const std::optional<ddacontact::Scene>& scene,
                    const std::filesystem::path& directory);
void tell_frames(Answer& answer, const std::filesystem::path& directory);
void tell_files(Answer& answer, const std::filesystem::path& directory);

}  // namespace dda
