/// \file The text of a scene, put together table by table.
#pragma once

#include <ddacontact/core/types.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// Number as short as it reads back.
std::string text_of(double value);
/// "[x, y]"
std::string text_of(const Vec2& point);
/// "[[x, y], ...]"
std::string text_of(const std::vector<Vec2>& points);

/// [[block]] with the lines of `rest` behind its vertices.
std::string block_text(std::string_view name, const std::vector<Vec2>& vertices,
                       std::string_view rest = "material = \"rock\"\n");

/// A rectangle, counter-clockwise.
std::vector<Vec2> rectangle(double left, double bottom, double right, double top);

/// The beginning of a scene, with these lines of [analysis] and gravity.
std::string head_text(std::string_view title, std::string_view analysis);

}  // namespace ddacontact
