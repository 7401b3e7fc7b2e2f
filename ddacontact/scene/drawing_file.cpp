#include <ddacontact/scene/drawing_file.hpp>

#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/area_moments.hpp>

namespace ddacontact::scene_format {

bool is_drawing(const std::string& path) {
  const std::string ending = small_ending(path);
  return ending == ".dxf" || ending == ".geo";
}

Drawing read_drawing(const std::string& path, const std::string& text, ProblemList& problems) {
  const auto source = std::make_shared<const std::string>(path);
  return small_ending(path) == ".dxf" ? read_dxf(text, source, problems)
                                      : read_shi_geometry(text, source, problems);
}

GeometryBlocks blocks_of(const Drawing& drawing, const std::string& path, ProblemList& problems) {
  GeometryBlocks result;
  result.complete = drawing.complete;
  int n_open = 0;
  for (const DrawnLine& line : drawing.lines) {
    if (!line.closed || line.points.cols() < 3) {
      ++n_open;
      continue;
    }
    BlockRecord& block = result.blocks.emplace_back();
    block.origin = "line " + std::to_string(line.location.line);
    block.locations.table = line.location;
    block.locations.add("vertices", line.location, true);
    block.vertices.points = line.points;
    if (!line.layer.empty()) block.groups.push_back(line.layer);
  }
  if (n_open > 0)
    problems.warning({std::make_shared<const std::string>(path), 1, 1},
                     "skipped: " + std::to_string(n_open) + " open lines, which are no blocks",
                     "close them, or name the file as 'boundary' of [domain]: lines cut blocks there");
  return result;
}

const DrawnLine* boundary_of(const Drawing& drawing, const std::string& path, ProblemList& problems) {
  const DrawnLine* largest = nullptr;
  const auto area = [](const DrawnLine& line) { return std::abs(polyfem::signed_area(line.points)); };
  for (const DrawnLine& line : drawing.lines)
    if (line.closed && line.points.cols() > 2 && (!largest || area(line) > area(*largest))) largest = &line;
  if (!largest && drawing.complete)
    problems.error({std::make_shared<const std::string>(path), 1, 1}, "the drawing has no closed line",
                   "draw the boundary of the domain as a closed polyline");
  return largest;
}

}  // namespace ddacontact::scene_format
