/// \file [parameters]: numbers that a scene calls "$name" wherever a number stands.
///
/// A value "$name" becomes "$name = VALUE", with the place that it had; readers of numbers take VALUE. Of an
/// unknown name it is "$name = ", which no reader takes.
#pragma once

#include <ddacontact/scene/toml_file.hpp>
#include <ddacontact/scene/units.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace ddacontact::scene_format {

/// Puts the parameters in place, in all of the scene but its title and its names. A parameter that is no
/// number, with or without a unit, and a name that none has are problems.
void put_parameters(toml::table& root, ProblemList& problems);

/// Whether a string stands for a parameter with its value.
bool is_parameter(std::string_view text);
/// Whether it stands for a parameter that has none: that is a problem already.
bool is_unknown_parameter(const toml::node& node);
/// The VALUE of such a string, see read_quantity; it may be without a unit.
QuantityReading read_parameter(std::string_view text, std::string_view unit, std::string_view other_unit);

/// A whole number, also one that a parameter gives.
std::optional<std::int64_t> whole_number(const toml::node& node);

}  // namespace ddacontact::scene_format
