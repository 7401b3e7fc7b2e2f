#include <ddacontact/picture/water_layer.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

const Colour water_blue{20, 90, 200};

std::string look_of_table(bool in_joints) {
  return "stroke=\"" + hex(water_blue) + "\" stroke-width=\"1.5\"" +
         (in_joints ? " stroke-dasharray=\"6 4\"" : "");
}

struct TableSegment {
  Vec2 from, to;
};

/// The part of a segment inside the box, along an axis; none where it is outside.
bool shorten(TableSegment& segment, const Window& box, int axis) {
  const Vec2 along = segment.to - segment.from;
  double first = 0, last = 1;
  for (const double side : {1., -1.}) {
    const double bound = side > 0 ? box.low[axis] : -box.high[axis],
                 start = side * segment.from[axis] - bound, slope = side * along[axis];
    if (slope > 0) first = std::max(first, -start / slope);
    if (slope < 0) last = std::min(last, -start / slope);
    if (slope == 0 && start < 0) return false;
  }
  if (first > last) return false;
  segment = {segment.from + first * along, segment.from + last * along};
  return true;
}

std::vector<TableSegment> inside(const Points& table, const Window& box) {
  std::vector<TableSegment> segments;
  if (table.cols() == 0) return segments;
  std::vector<Vec2> points;
  if (box.low.x() < table(0, 0)) points.emplace_back(box.low.x(), table(1, 0));
  for (Index k = 0; k < table.cols(); ++k) points.emplace_back(table.col(k));
  const Vec2 last = points.back();
  if (last.x() < box.high.x()) points.emplace_back(box.high.x(), last.y());
  for (std::size_t k = 1; k < points.size(); ++k) {
    TableSegment segment{points[k - 1], points[k]};
    if (shorten(segment, box, 0) && shorten(segment, box, 1)) segments.push_back(segment);
  }
  return segments;
}

LegendItem table_sample(bool in_joints) {
  return line_sample(look_of_table(in_joints), in_joints ? "water table of joints" : "water table");
}

}  // namespace

void draw_water(SvgPage& page, const View& view, const Water& water) {
  const auto draw = [&](const Points& table, bool in_joints) {
    for (const auto& [from, to] : inside(table, view.box))
      page.line(view(from), view(to), look_of_table(in_joints));
  };
  draw(water.table, false);
  if (water.tells_joints()) draw(water.joint_table, true);
}

Window with_water(const Window& box, const Water& water) {
  Window all = box;
  const Window column{{box.low.x(), box.low.y()}, {box.high.x(), HUGE_VAL}};
  for (const Points* table : {&water.table, &water.joint_table})
    for (const auto& [from, to] : inside(*table, column))
      all.high.y() = std::max({all.high.y(), from.y(), to.y()});
  return all;
}

std::vector<LegendItem> water_explanations(const std::vector<Water>& waters,
                                           const std::vector<Window>& boxes) {
  bool any = false, any_of_joints = false;
  for (std::size_t k = 0; k < waters.size(); ++k) {
    any = any || !inside(waters[k].table, boxes[k]).empty();
    any_of_joints =
        any_of_joints || (waters[k].tells_joints() && !inside(waters[k].joint_table, boxes[k]).empty());
  }
  std::vector<LegendItem> items;
  if (any) items.push_back(table_sample(false));
  if (any_of_joints) items.push_back(table_sample(true));
  return items;
}

}  // namespace ddacontact
