/// \file What the presets choose, in words.
#pragma once

#include <ddacontact/core/options.hpp>
#include <ddacontact/scene/value_text.hpp>

#include <string>

namespace ddacontact::scene_format {

/// A default in words, for the documentation: `true`; preset "paper": `false`.
template <class T>
std::string preset_text(T Defaults::*member) {
  return '`' + value_text(standard_defaults.*member) + "`; preset \"paper\": `" +
         value_text(paper_defaults.*member) + '`';
}

}  // namespace ddacontact::scene_format
