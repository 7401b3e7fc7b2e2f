/// \file In place of rendered_svg.cpp where librsvg was not found.
#include "rendered_svg.hpp"

#include <ddacontact/core/types.hpp>

namespace dda {

bool can_render_svg() {
  return false;
}

void write_png(const std::string& path, const std::string&) {
  throw ddacontact::Error("built without librsvg: cannot write \"" + path + "\"");
}

void write_pdf(const std::string& path, const std::string& svg) {
  write_png(path, svg);
}

}  // namespace dda
