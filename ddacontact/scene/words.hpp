/// \file The words of the scene format that stand for a choice.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <optional>
#include <type_traits>
#include <vector>

namespace ddacontact::scene_format {

/// A word and what it chooses; nothing where the format has the word but this version has not the thing.
template <class Choice>
struct Word {
  const char* text;
  std::optional<Choice> choice;
};

/// The words of each choice. A choice is written as the first word that stands for it.
const std::vector<Word<Preset>>& words_of(Preset);
const std::vector<Word<Mode>>& words_of(Mode);
const std::vector<Word<Plane>>& words_of(Plane);
const std::vector<Word<BlockModel>>& words_of(BlockModel);
const std::vector<Word<Kinematics>>& words_of(Kinematics);
const std::vector<Word<Scheme>>& words_of(Scheme);
const std::vector<Word<ContactMethod>>& words_of(ContactMethod);
const std::vector<Word<Axes>>& words_of(Axes);
const std::vector<Word<Load::Kind>>& words_of(Load::Kind);

/// A type whose values are words.
template <class T>
concept Choice = std::is_enum_v<T> && !std::is_same_v<T, GradientCorrection>;

/// The words that `output.fields` may hold.
const std::vector<Word<std::string>>& field_words();

}  // namespace ddacontact::scene_format
