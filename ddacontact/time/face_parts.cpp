#include <ddacontact/time/face_parts.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/touching_edges.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

struct Touch {
  double from, to;
  int neighbour;
};
/// Of every edge of every block.
using Touches = std::vector<std::vector<std::vector<Touch>>>;

}  // namespace

std::vector<FacePart> divide_faces(const BlockSystem& blocks) {
  const Points x = blocks.reference();
  const auto outline = [&](int b) {
    return x.middleCols(blocks.block(b).vertices().first, blocks.block(b).n_vertices());
  };
  std::vector<Box> boxes;
  Touches touches;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    boxes.push_back(bounding_box(outline(b), edges_touch * blocks.block(b).size()));
    touches.emplace_back(blocks.block(b).n_vertices());
  }
  const auto add = [&](int block, int neighbour, double near) {
    for (const TouchingEdges& touch : touching_edges(outline(block), outline(neighbour), near))
      touches[block][touch.edge].push_back({touch.from, touch.to, neighbour});
  };
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    const double near = edges_touch * std::min(blocks.block(a).size(), blocks.block(b).size());
    add(a, b, near);
    add(b, a, near);
  }
  std::vector<FacePart> parts;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    for (int edge = 0; edge < blocks.block(b).n_vertices(); ++edge) {
      std::vector<Touch>& of_edge = touches[b][edge];
      std::ranges::sort(of_edge, {}, &Touch::from);
      double at = 0;
      for (const Touch& touch : of_edge) {
        if (touch.from > at) parts.push_back({{b, edge, at, touch.from}, -1});
        if (touch.to > std::max(at, touch.from))
          parts.push_back({{b, edge, std::max(at, touch.from), touch.to}, touch.neighbour});
        at = std::max(at, touch.to);
      }
      if (at < 1) parts.push_back({{b, edge, at, 1}, -1});
    }
  return parts;
}

std::vector<WetFace> present_faces(const BlockSystem& blocks, const std::vector<FacePart>& parts) {
  std::vector<WetFace> faces;
  for (const FacePart& part : parts) {
    if (!blocks.is_present(part.face.block)) continue;
    faces.push_back(part.face);
    faces.back().in_joint = part.neighbour >= 0 && blocks.is_present(part.neighbour);
  }
  return faces;
}

}  // namespace ddacontact
