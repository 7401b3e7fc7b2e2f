#include "picture_file.hpp"

#include "call_error.hpp"
#include "rendered_svg.hpp"

#include <fmt/format.h>
#include <ddacontact/output/whole_file.hpp>

#include <filesystem>

namespace dda {

void expect_picture_name(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".svg") return;
  if (ending != ".png" && ending != ".pdf")
    throw CallError(fmt::format("-o \"{}\": the name must end in .svg, .png or .pdf", path));
  if (!can_render_svg())
    throw CallError(
        fmt::format("-o \"{}\": this program was built without librsvg, which PNG and PDF need (name the "
                    "picture .svg, or install the package librsvg2-dev and build again)",
                    path));
}

void write_picture(const std::string& path, const std::string& svg) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".png") return write_png(path, svg);
  if (ending == ".pdf") return write_pdf(path, svg);
  ddacontact::write_whole(path, [&](std::ostream& out) { out << svg; });
}

}  // namespace dda
