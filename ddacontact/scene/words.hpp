/// \file The words of the scene format that stand for a choice.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <string>
#include <type_traits>
#include <vector>

namespace ddacontact::scene_format {

/// A word and what it chooses.
template <class Choice>
struct Word {
  const char* text;
  Choice choice;
};

/// The words of each choice.
const std::vector<Word<Preset>>& words_of(Preset);
const std::vector<Word<Mode>>& words_of(Mode);
const std::vector<Word<Plane>>& words_of(Plane);
const std::vector<Word<BlockModel>>& words_of(BlockModel);
const std::vector<Word<CellKind>>& words_of(CellKind);
const std::vector<Word<Kinematics>>& words_of(Kinematics);
const std::vector<Word<Scheme>>& words_of(Scheme);
const std::vector<Word<ContactMethod>>& words_of(ContactMethod);
const std::vector<Word<Axes>>& words_of(Axes);
const std::vector<Word<Interpolation>>& words_of(Interpolation);
const std::vector<Word<Load::Kind>>& words_of(Load::Kind);
const std::vector<Word<RockBolt::Kind>>& words_of(RockBolt::Kind);
const std::vector<Word<SliverPolicy>>& words_of(SliverPolicy);
const std::vector<Word<TVertices>>& words_of(TVertices);

/// A type whose values are words.
template <class T>
concept Choice = std::is_enum_v<T> && !std::is_same_v<T, GradientCorrection>;

/// The words that `output.fields` may hold.
const std::vector<Word<std::string>>& field_words();

}  // namespace ddacontact::scene_format
