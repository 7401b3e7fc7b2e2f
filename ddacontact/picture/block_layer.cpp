#include <ddacontact/picture/block_layer.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace ddacontact {

namespace {

void add_outline(PathData& data, const View& view, const PointsRef& outline) {
  std::vector<Vec2> corners;
  for (Index i = 0; i < outline.cols(); ++i) corners.push_back(view(outline.col(i)));
  data.polygon(corners);
}

PathData all_outlines(const View& view, const Frame& frame) {
  PathData data;
  for (int b = 0; b < frame.n_blocks(); ++b) add_outline(data, view, frame.outline(b));
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
  for (int b = 0; b < frame.n_blocks(); ++b) {
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

void draw_reference(SvgPage& page, const View& view, const Frame& frame) {
  PathData data;
  for (int b = 0; b < frame.n_blocks(); ++b) {
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
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const auto block = static_cast<std::size_t>(b);
    const bool named = block < names.size() && !names[block].empty();
    const std::string name = named ? names[block] : std::to_string(b);
    const auto outline = frame.outline(b);
    const Vec2 extent = view.scale * (outline.rowwise().maxCoeff() - outline.rowwise().minCoeff());
    const double size = std::min({largest, 0.8 * extent.x() / text_width(name, 1), 0.6 * extent.y()});
    if (size < smallest) continue;
    const Vec2 middle = view(centroid(frame, b));
    page.text(middle + Vec2(0, 0.35 * size), name, {.size = size, .anchor = Anchor::middle, .halo = true});
  }
}

Vec2 centroid(const Frame& frame, int block) {
  return polyfem::area_moments(frame.outline(block)).centroid;
}

}  // namespace ddacontact
