/// \file Pictures as files: SVG, PNG, PDF.
#pragma once

#include <string>

namespace dda {

/// Throws CallError unless the name ends in .svg, .png or .pdf and this program can write that.
void expect_picture_name(const std::string& path);

/// Writes an SVG text as what the name's ending says: PNG with two dots a pixel, PDF with 96 pixels an inch.
/// Throws OutputError when it cannot be written.
void write_picture(const std::string& path, const std::string& svg);

}  // namespace dda
