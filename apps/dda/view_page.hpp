/// \file The page of `dda view` before a run is put into it.
#pragma once

#include <string_view>

namespace dda {

/// apps/viewer/page.html as it was when the program was built. The run goes where its two marks
/// `first_data_mark` and `more_data_mark` stand, each once.
std::string_view view_page();

constexpr std::string_view first_data_mark = "<!--first data-->";
constexpr std::string_view more_data_mark = "<!--more data-->";

}  // namespace dda
