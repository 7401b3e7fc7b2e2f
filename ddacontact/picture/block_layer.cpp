#include <ddacontact/picture/block_layer.hpp>

#include <ddacontact/output/cell_pieces.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace ddacontact {

namespace {

void add_outline(PathData& data, const View& view, const PointsRef& outline) {
  std::vector<Vec2> corners;
  for (Index i = 0; i < outline.cols(); ++i) corners.push_back(view(outline.col(i)));
  data.polygon(corners);
}

PathData all_outlines(const View& view, const Frame& frame) {
  PathData data;
  for (int b : frame.present_blocks()) add_outline(data, view, frame.outline(b));
  return data;
}

/// Numbers without a pattern, so that neighbours in rows differ.
int mixed(int b) {
  return static_cast<int>(static_cast<std::uint32_t>(b) * 2654435769u >> 29);
}

std::string stroke_width(double pixels) {
  return "stroke-width=\"" + pixel_text(pixels) + "\"";
}

}  // namespace

void draw_kinds(SvgPage& page, const View& view, const Frame& frame, Field field) {
  std::map<int, PathData> kinds;
  for (int b : frame.present_blocks()) {
    const int kind = field == Field::material ? frame.materials[static_cast<std::size_t>(b)] : mixed(b);
    add_outline(kinds[kind], view, frame.outline(b));
  }
  for (const auto& [kind, data] : kinds) page.path(data, "fill=\"" + hex(kind_colour(kind)) + "\"");
}

void draw_fill(SvgPage& page, const View& view, const Frame& frame) {
  page.path(all_outlines(view, frame), "fill=\"#f1efe9\"");
}

void draw_outlines(SvgPage& page, const View& view, const Frame& frame) {
  const double width = std::clamp(0.025 * view.scale * typical_size(frame), 0.15, 0.8);
  page.path(all_outlines(view, frame),
            "fill=\"none\" stroke=\"#222\" stroke-linejoin=\"round\" " + stroke_width(width));
}

void draw_cell_edges(SvgPage& page, const View& view, const Frame& frame) {
  constexpr double smallest = 8;  // pixels
  PathData data;
  for (int c = 0, end = 0; c < frame.n_cells(); c = end) {
    const int b = frame.cells[static_cast<std::size_t>(c)].block;
    while (end < frame.n_cells() && frame.cells[static_cast<std::size_t>(end)].block == b) ++end;
    const double area = std::abs(polyfem::signed_area(frame.outline(b)));
    if (end == c + 1 || view.scale * std::sqrt(area / (end - c)) < smallest) continue;
    std::set<std::pair<int, int>> seen;
    for (int cell = c; cell < end; ++cell) {
      const std::span<const int> points = frame.corners(cell);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const int from = points[k], to = points[(k + 1) % points.size()];
        if (!seen.insert({std::min(from, to), std::max(from, to)}).second) continue;
        data.move_to(view(frame.position.col(from)));
        data.line_to(view(frame.position.col(to)));
      }
    }
  }
  page.path(data, "fill=\"none\" stroke=\"#222\" stroke-opacity=\"0.25\" " + stroke_width(0.4));
}

void draw_reference(SvgPage& page, const View& view, const Frame& frame) {
  PathData data;
  for (int b : frame.present_blocks()) {
    const Range& range = frame.blocks[static_cast<std::size_t>(b)];
    add_outline(data, view, frame.outline(b) - frame.displacement.middleCols(range.first, range.count));
  }
  const double size = view.scale * typical_size(frame);
  const std::string dash = pixel_text(std::clamp(0.12 * size, 1.5, 4.));
  page.path(data, "fill=\"none\" stroke=\"#777\" stroke-dasharray=\"" + dash + "\" " +
                      stroke_width(std::clamp(0.02 * size, 0.3, 0.7)));
}

void draw_names(SvgPage& page, const View& view, const Frame& frame, const std::vector<std::string>& names) {
  constexpr double largest = 12, smallest = 5;
  for (int b : frame.present_blocks()) {
    const auto block = static_cast<std::size_t>(b);
    const bool named = block < names.size() && !names[block].empty();
    const std::string name = named ? names[block] : std::to_string(b);
    const auto outline = frame.outline(b);
    const Vec2 extent = view.scale * (outline.rowwise().maxCoeff() - outline.rowwise().minCoeff());
    const double size = std::min({largest, 0.8 * extent.x() / text_width(name, 1), 0.6 * extent.y()});
    if (size < smallest) continue;
    page.text(view(middle(frame, b)) + Vec2(0, 0.35 * size), name,
              {.size = size, .anchor = Anchor::middle, .halo = true});
  }
}

Vec2 middle(const Frame& frame, int block) {
  const auto outline = frame.outline(block);
  const Vec2 centroid = polyfem::area_moments(outline).centroid;
  double largest = 0;
  Vec2 middle = centroid;
  if (polyfem::contains(outline, centroid)) return centroid;
  for (const CellPiece& piece : pieces_of(outline)) {
    const auto moments = polyfem::area_moments(outline(Eigen::all, piece));
    if (moments.area > largest) middle = moments.centroid;
    largest = std::max(largest, moments.area);
  }
  return middle;
}

}  // namespace ddacontact
