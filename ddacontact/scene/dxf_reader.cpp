#include <ddacontact/scene/drawing.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace ddacontact::scene_format {

namespace {

/// A group: two lines of the file.
struct Group {
  int code = 0;
  std::string value;
  int line = 0;  ///< of the value
};

/// What ends the reading.
struct DxfError {
  int line;
  std::string what, cure;
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

class Groups {
 public:
  explicit Groups(const std::string& text) : text_(text) { next(); }

  const Group& now() const { return now_; }
  bool at_end() const { return at_end_; }
  void next() {
    at_end_ = at_ >= text_.size();
    if (at_end_) return;
    const std::string word = trimmed(line());
    const std::optional<int> code = number_of<int>(word);
    if (!code)
      throw DxfError{n_lines_, "'" + excerpt(word) + "' is no group code",
                     "save the drawing as ASCII DXF; the file is read no further"};
    if (at_ >= text_.size())
      throw DxfError{n_lines_, "the file ends within a group", "it is cut short: save the drawing again"};
    now_ = {*code, trimmed(line()), n_lines_};
  }
  bool starts(const char* entity) const { return now_.code == 0 && now_.value == entity; }
  double number() const {
    const std::optional<double> number = number_of<double>(now_.value);
    if (!number || !(std::abs(*number) <= largest_number))
      throw DxfError{now_.line, "'" + excerpt(now_.value) + "' is no number",
                     "expected a coordinate; the file is read no further"};
    return *number;
  }

 private:
  std::string line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string result = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++n_lines_;
    return result;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int n_lines_ = 0;
  bool at_end_ = false;
  Group now_;
};

/// Points of an arc from one angle on by another, radians, without its end.
void add_arc(const Vec2& centre, double radius, double from, double by, std::vector<Vec2>& points) {
  const int n = std::max(1, static_cast<int>(std::ceil(std::abs(by) / (std::numbers::pi / 12) - 1e-9)));
  for (int k = 0; k < n; ++k) {
    const double angle = from + by * k / n;
    points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
}

/// A vertex of a polyline; the tangent of a quarter of the angle of the arc to the next one.
struct Vertex {
  Vec2 point{0, 0};
  double bulge = 0;
};

class DxfReader {
 public:
  DxfReader(const std::string& text, std::shared_ptr<const std::string> source, ProblemList& problems)
      : groups_(text), source_(std::move(source)), problems_(problems) {}

  Drawing read() {
    find_entities();
    while (!groups_.starts("ENDSEC")) {
      if (groups_.at_end())
        throw DxfError{groups_.now().line, "the file ends within its entities",
                       "it is cut short: save the drawing again"};
      read_entity();
    }
    tell_skipped();
    drawing_.complete = true;
    return std::move(drawing_);
  }

 private:
  static constexpr double missing = std::numeric_limits<double>::infinity();  ///< no coordinate of a file
  /// m, of what counts as level
  static constexpr double small_height = 1e-6;
  static constexpr int surface_flags = 16 | 64;  ///< of group 70: a mesh of vertices, faces of a solid

  void find_entities() {
    for (; !groups_.at_end(); groups_.next()) {
      if (groups_.now().code == 9 && groups_.now().value == "$INSUNITS") read_unit();
      if (groups_.now().code == 2 && groups_.now().value == "ENTITIES") return groups_.next();
    }
    throw DxfError{1, "the file has no section ENTITIES", "save the drawing as ASCII DXF"};
  }

  void read_unit() {
    groups_.next();
    if (groups_.now().value == "0" || groups_.now().value == "6") return;
    problems_.warning(location(groups_.now().line), "the drawing's unit ($INSUNITS) is not the metre",
                      "its numbers are taken as m: scale it if they are not");
  }

  SourceLocation location(int line) const { return {source_, line, 1}; }

  /// One entity, up to the next one.
  void read_entity() {
    const Group start = groups_.now();
    DrawnLine line;
    line.location = location(start.line);
    std::vector<Vertex> vertices;
    std::map<int, double> numbers;
    bool in_paper_space = false, is_surface = false, faces_down = false;
    for (groups_.next(); !groups_.at_end() && groups_.now().code != 0; groups_.next()) {
      const Group& group = groups_.now();
      if (group.code == 8) line.layer = group.value;
      if (group.code == 67) in_paper_space = group.value == "1";
      if (group.code == 70) line.closed = number_of<int>(group.value).value_or(0) % 2 == 1;
      if (group.code == 70) is_surface = (number_of<int>(group.value).value_or(0) & surface_flags) != 0;
      if (group.code == 230) faces_down = groups_.number() < 0;
      if (start.value == "LWPOLYLINE") add_group(vertices, start);
      if ((group.code >= 10 && group.code < 60)) numbers[group.code] = groups_.number();
    }
    if (start.value == "LWPOLYLINE") expect_whole(vertices, start);
    std::vector<double> heights{0};
    if (start.value == "POLYLINE") vertices = read_vertices(heights);
    if (in_paper_space) return static_cast<void>(++skipped_[start.value + " of the paper space"]);
    if (start.value == "POLYLINE" && is_surface)
      return static_cast<void>(++skipped_["POLYLINE of a surface"]);
    const bool is_circle = start.value == "CIRCLE", is_arc = start.value == "ARC",
               is_line = start.value == "LINE";
    if (!is_line && !is_circle && !is_arc && start.value != "LWPOLYLINE" && start.value != "POLYLINE")
      return static_cast<void>(++skipped_[start.value]);
    if (faces_down && !is_line)
      throw DxfError{start.line, "the " + start.value + " is drawn mirrored (group 230 is negative)",
                     "redraw it seen from above, or explode it into lines"};
    expect_groups(numbers, start,
                  is_line     ? std::vector{10, 20, 11, 21}
                  : is_circle ? std::vector{10, 20, 40}
                  : is_arc    ? std::vector{10, 20, 40, 50, 51}
                              : std::vector<int>{});
    if (is_line) vertices = {{{numbers[10], numbers[20]}, 0}, {{numbers[11], numbers[21]}, 0}};
    if (is_line) heights = {numbers[30], numbers[31]};
    const auto [lowest, highest] = std::ranges::minmax(heights);
    if (highest - lowest > small_height) ++n_inclined_;
    if (!is_circle && !is_arc) return add(vertices, std::move(line));
    if (!(numbers[40] > 0))
      throw DxfError{start.line, "the radius of the " + start.value + " is not positive", "correct group 40"};
    add_circle(numbers, is_circle, std::move(line));
  }

  static void expect_groups(const std::map<int, double>& numbers, const Group& start,
                            const std::vector<int>& codes) {
    for (const int code : codes)
      if (!numbers.contains(code))
        throw DxfError{start.line, "the " + start.value + " has no group " + std::to_string(code),
                       "the file is damaged: save the drawing again"};
  }

  /// Of a vertex of a polyline: x begins the next one.
  void add_group(std::vector<Vertex>& vertices, const Group& start) {
    const Group& group = groups_.now();
    if (group.code == 10) {
      expect_whole(vertices, start);
      vertices.push_back({{groups_.number(), missing}, 0});
    }
    if (vertices.empty()) return;
    if (group.code == 20) vertices.back().point.y() = groups_.number();
    if (group.code == 42) vertices.back().bulge = groups_.number();
  }
  static void expect_whole(const std::vector<Vertex>& vertices, const Group& start) {
    if (!vertices.empty() && vertices.back().point.y() == missing)
      throw DxfError{
          start.line,
          "vertex " + std::to_string(vertices.size() - 1) + " of the " + start.value + " has no group 20",
          "the file is damaged: save the drawing again"};
  }

  /// The entities VERTEX behind a POLYLINE.
  std::vector<Vertex> read_vertices(std::vector<double>& heights) {
    std::vector<Vertex> vertices;
    heights.clear();
    while (groups_.starts("VERTEX")) {
      const Group start = groups_.now();
      std::map<int, double> numbers;
      for (groups_.next(); !groups_.at_end() && groups_.now().code != 0; groups_.next())
        if (groups_.now().code >= 10 && groups_.now().code < 60)
          numbers[groups_.now().code] = groups_.number();
      expect_groups(numbers, start, {10, 20});
      vertices.push_back({{numbers[10], numbers[20]}, numbers[42]});
      heights.push_back(numbers[30]);
    }
    if (heights.empty()) heights = {0};
    if (groups_.starts("SEQEND")) do
        groups_.next();
      while (!groups_.at_end() && groups_.now().code != 0);
    return vertices;
  }

  void add_circle(std::map<int, double>& numbers, bool closed, DrawnLine line) {
    const Vec2 centre(numbers[10], numbers[20]);
    const double radius = numbers[40], degree = std::numbers::pi / 180,
                 from = closed ? 0 : numbers[50] * degree;
    double by = closed ? 2 * std::numbers::pi : numbers[51] * degree - from;
    if (by <= 0) by += 2 * std::numbers::pi;
    std::vector<Vec2> points;
    add_arc(centre, radius, from, by, points);
    if (!closed) points.emplace_back(centre + radius * Vec2(std::cos(from + by), std::sin(from + by)));
    line.closed = closed;
    add(points, std::move(line));
  }

  void add(std::vector<Vertex> vertices, DrawnLine line) {
    if (vertices.size() > 2 && vertices.front().point == vertices.back().point) {
      vertices.pop_back();
      line.closed = true;
    }
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const auto& [point, bulge] = vertices[k];
      const bool is_last = k + 1 == vertices.size();
      if (bulge == 0 || (is_last && !line.closed)) {
        points.push_back(point);
        continue;
      }
      const Vec2 chord = vertices[(k + 1) % vertices.size()].point - point;
      const double by = 4 * std::atan(bulge);
      const Vec2 centre = point + chord / 2 + (1 - bulge * bulge) / (4 * bulge) * Vec2(-chord.y(), chord.x());
      const Vec2 arm = point - centre;
      const std::size_t first = points.size();
      add_arc(centre, arm.norm(), std::atan2(arm.y(), arm.x()), by, points);
      points[first] = point;
    }
    add(points, std::move(line));
  }

  /// Without repeated points.
  void add(const std::vector<Vec2>& points, DrawnLine line) {
    std::vector<Vec2> kept;
    for (const Vec2& point : points)
      if (kept.empty() || point != kept.back()) kept.push_back(point);
    if (line.closed && kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() < 2) return static_cast<void>(++skipped_["line without length"]);
    line.points.resize(2, static_cast<Index>(kept.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) line.points.col(static_cast<Index>(k)) = kept[k];
    drawing_.lines.push_back(std::move(line));
  }

  void tell_skipped() {
    if (n_inclined_ > 0)
      problems_.warning(
          location(1),
          "out of the plane x-y run " + std::to_string(n_inclined_) + " of the lines: z is left out",
          "is it a section? Project joints measured in space onto it first");
    std::string list;
    for (const auto& [kind, count] : skipped_)
      list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + excerpt(kind);
    if (!list.empty())
      problems_.warning(location(1), "skipped: " + list,
                        "read are LINE, LWPOLYLINE, POLYLINE, CIRCLE and ARC: explode others into these");
  }

  Groups groups_;
  std::shared_ptr<const std::string> source_;
  ProblemList& problems_;
  Drawing drawing_;
  std::map<std::string, int> skipped_;
  int n_inclined_ = 0;  ///< lines whose ends have different z
};

}  // namespace

Drawing read_dxf(const std::string& text, const std::shared_ptr<const std::string>& source,
                 ProblemList& problems) {
  try {
    return DxfReader(text, source, problems).read();
  } catch (const DxfError& error) {
    problems.error({source, error.line, 1}, error.what, error.cure);
    return {};
  }
}

}  // namespace ddacontact::scene_format
