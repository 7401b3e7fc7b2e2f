/// \file SVG drawn by librsvg and cairo.
#pragma once

#include <string>

namespace dda {

/// Whether the program was built with librsvg; else the two others must not be called.
bool can_render_svg();

/// Both throw OutputError, which names the file, when it cannot be written.
void write_png(const std::string& path, const std::string& svg);
void write_pdf(const std::string& path, const std::string& svg);

}  // namespace dda
