#include <ddacontact/scene/scene_text.hpp>

#include <ddacontact/scene/text.hpp>

namespace ddacontact {

std::string text_of(double value) {
  return scene_format::short_number(value + 0.0);
}

std::string text_of(const Vec2& point) {
  return '[' + text_of(point.x()) + ", " + text_of(point.y()) + ']';
}

std::string text_of(const std::vector<Vec2>& points) {
  std::string text = "[";
  for (const Vec2& point : points) text += (text.size() > 1 ? ", " : "") + text_of(point);
  return text + ']';
}

std::string block_text(std::string_view name, const std::vector<Vec2>& vertices, std::string_view rest) {
  return "\n[[block]]\nname = \"" + std::string(name) + "\"\nvertices = " + text_of(vertices) + '\n' +
         std::string(rest);
}

std::vector<Vec2> rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

std::string head_text(std::string_view title, std::string_view analysis) {
  return "format = 1\ntitle = \"" + std::string(title) + "\"\n\n[analysis]\n" + std::string(analysis) +
         "gravity   = [0.0, -9.8]       # m/s2\n";
}

}  // namespace ddacontact
