/// \file Lists, ranges and windows as words of a call.
#pragma once

#include <ddacontact/picture/picture.hpp>

#include <string>
#include <vector>

namespace dda {

/// The words of lists like "s1,s2".
std::vector<std::string> single_words(const std::vector<std::string>& lists);

/// "MIN,MAX" in the unit of the fields, or each with its own; throws CallError when it is not that, or the
/// fields have not all one unit.
ddacontact::ValueRange colour_range(const std::string& text, const std::vector<ddacontact::Field>& fields);

/// "XMIN,XMAX,YMIN,YMAX" in m, or each with its unit; throws CallError.
ddacontact::Window window(const std::string& text);

}  // namespace dda
