#include <ddacontact/scene/drawing.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <charconv>
#include <cmath>
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
        throw DxfError{groups_.now().line, "the file ends within its entities", "save the drawing again"};
      read_entity();
    }
    tell_skipped();
    drawing_.complete = true;
    return std::move(drawing_);
  }

 private:
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
    bool in_paper_space = false;
    for (groups_.next(); !groups_.at_end() && groups_.now().code != 0; groups_.next()) {
      const Group& group = groups_.now();
      if (group.code == 8) line.layer = group.value;
      if (group.code == 67) in_paper_space = group.value == "1";
      if (group.code == 70) line.closed = number_of<int>(group.value).value_or(0) % 2 == 1;
      if (start.value == "LWPOLYLINE" && group.code == 10) vertices.push_back({{groups_.number(), 0}, 0});
      if (start.value == "LWPOLYLINE" && group.code == 20 && !vertices.empty())
        vertices.back().point.y() = groups_.number();
      if (start.value == "LWPOLYLINE" && group.code == 42 && !vertices.empty())
        vertices.back().bulge = groups_.number();
      if ((group.code >= 10 && group.code < 60)) numbers[group.code] = groups_.number();
    }
    if (start.value == "POLYLINE") vertices = read_vertices();
    if (in_paper_space) return;
    if (start.value == "LINE")
      vertices = {{{numbers[10], numbers[20]}, 0}, {{numbers[11], numbers[21]}, 0}};
    else if (start.value == "CIRCLE" || start.value == "ARC")
      return add_circle(numbers, start.value == "CIRCLE", std::move(line));
    else if (start.value != "LWPOLYLINE" && start.value != "POLYLINE")
      return static_cast<void>(++skipped_[start.value]);
    add(vertices, std::move(line));
  }

  /// The entities VERTEX behind a POLYLINE.
  std::vector<Vertex> read_vertices() {
    std::vector<Vertex> vertices;
    while (groups_.starts("VERTEX")) {
      Vertex& vertex = vertices.emplace_back();
      for (groups_.next(); !groups_.at_end() && groups_.now().code != 0; groups_.next()) {
        if (groups_.now().code == 10) vertex.point.x() = groups_.number();
        if (groups_.now().code == 20) vertex.point.y() = groups_.number();
        if (groups_.now().code == 42) vertex.bulge = groups_.number();
      }
    }
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
