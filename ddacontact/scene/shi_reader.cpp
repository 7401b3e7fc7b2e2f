#include <ddacontact/scene/drawing.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <charconv>
#include <cmath>

namespace ddacontact::scene_format {

namespace {

/// What ends the reading.
struct ShiError {
  int line, column;
  std::string what, cure;
};

class ShiReader {
 public:
  ShiReader(const std::string& text, std::shared_ptr<const std::string> source, ProblemList& problems)
      : text_(text), source_(std::move(source)), problems_(problems) {}

  Drawing read() {
    search_margin_ = number("the least distance of vertices");
    if (search_margin_ < 0)
      throw ShiError{line_, 1, "the least distance of vertices is negative", "expected a length in m"};
    const int n_joints = count("joint lines"), n_boundary = count("boundary lines"),
              n_materials = count("material lines"), n_bolts = count("bolts"), n_fixed = count("fixed lines"),
              n_points = count("loaded points") + count("measured points") + count("holes");
    if (n_boundary > n_joints)
      throw ShiError{line_, 1, "the file has more boundary lines than lines",
                     "boundary lines count among the joint lines"};
    std::vector<DrawnLine> boundary;
    for (int k = 0; k < n_joints; ++k) {
      DrawnLine line = joint_line();
      (k < n_boundary ? boundary : drawing_.lines).push_back(std::move(line));
    }
    chain(std::move(boundary));
    pass_over(n_materials, n_bolts, n_fixed, n_points);
    if (n_materials + n_bolts + n_fixed + n_points > 0)
      problems_.warning({source_, 1, 1},
                        "skipped: " + std::to_string(n_materials) + " material lines, " +
                            std::to_string(n_bolts) + " bolts, " + std::to_string(n_fixed) +
                            " fixed lines, " + std::to_string(n_points) + " points",
                        "write [[domain.region]], [[support]], [[load]] and [[monitor]]");
    drawing_.complete = true;
    return std::move(drawing_);
  }

 private:
  double number(const std::string& what) {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
      if (text_[at_] == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      }
      ++at_;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc() || !(std::abs(value) <= largest_number))
      throw ShiError{line_, static_cast<int>(at_ - line_start_) + 1,
                     at_ == text_.size() ? "the file ends too early"
                                         : "'" + excerpt(text_.substr(at_, 20)) + "' is no number",
                     "expected " + what + "; the file is read no further"};
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  int count(const std::string& what) {
    const double value = number("the number of " + what);
    if (value < 0 || value > 1e6 || value != std::floor(value))
      throw ShiError{line_, 1, "the number of " + what + " is no count", "expected a whole number"};
    return static_cast<int>(value);
  }

  /// What follows the joint lines is not used, but a file that is cut short is refused. The layout of bolts
  /// differs between versions of DC: nothing behind them is looked at.
  void pass_over(int n_materials, int n_bolts, int n_fixed, int n_points) {
    const auto pass = [&](int n, const std::string& what) {
      for (int k = 0; k < n; ++k) number(what);
    };
    pass(5 * n_materials, "x1 y1 x2 y2 and the material of a material line");
    if (n_bolts > 0) return;
    pass(4 * n_fixed, "x1 y1 x2 y2 of a fixed line");
    pass(2 * n_points, "x and y of a point");
    if (text_.find_first_not_of(" \t\r\n", at_) != std::string::npos)
      problems_.warning({source_, line_, 1}, "skipped: what follows the last item that the file counts",
                        "see that the counts at its beginning are right");
  }

  DrawnLine joint_line() {
    DrawnLine line;
    line.points.resize(2, 2);
    for (Index k = 0; k < 4; ++k) line.points(k % 2, k / 2) = number("x1 y1 x2 y2 and the type of a joint");
    line.layer = std::to_string(count("the joint type"));
    line.location = {source_, line_, 1};
    return line;
  }

  /// Joins lines at ends within the least distance of vertices.
  void chain(std::vector<DrawnLine> lines) {
    while (!lines.empty()) {
      std::vector<Vec2> points{lines.front().points.col(0), lines.front().points.col(1)};
      DrawnLine ring{{}, true, "boundary", lines.front().location};
      lines.erase(lines.begin());
      const auto near = [&](const Vec2& a, const Vec2& b) { return (a - b).norm() <= search_margin_; };
      for (auto next = lines.begin(); next != lines.end();) {
        const Vec2 a = next->points.col(0), b = next->points.col(1);
        if (!near(a, points.back()) && !near(b, points.back())) {
          ++next;
          continue;
        }
        points.push_back(near(a, points.back()) ? b : a);
        lines.erase(next);
        next = lines.begin();
      }
      if (points.size() < 4 || !near(points.front(), points.back()))
        throw ShiError{ring.location.line, 1, "the boundary lines do not close",
                       "each must begin where another one ends"};
      points.pop_back();
      ring.points.resize(2, static_cast<Index>(points.size()));
      for (std::size_t k = 0; k < points.size(); ++k) ring.points.col(static_cast<Index>(k)) = points[k];
      drawing_.lines.push_back(std::move(ring));
    }
  }

  const std::string& text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  double search_margin_ = 0;
  std::shared_ptr<const std::string> source_;
  ProblemList& problems_;
  Drawing drawing_;
};

}  // namespace

Drawing read_shi_geometry(const std::string& text, const std::shared_ptr<const std::string>& source,
                          ProblemList& problems) {
  try {
    return ShiReader(text, source, problems).read();
  } catch (const ShiError& error) {
    problems.error({source, error.line, error.column}, error.what, error.cure);
    return {};
  }
}

}  // namespace ddacontact::scene_format
