// Charts: lines where the numbers say, sound whatever the numbers are.

#include "frames.hpp"

#include <ddacontact/picture/chart.hpp>

#include <limits>

namespace {

using namespace support;

Chart chart_of(std::vector<Series> series) {
  Chart chart;
  chart.x_symbol = {"time", "", ""};
  chart.x_unit = "s";
  chart.y_symbol = {"u", "x", ""};
  chart.y_unit = "m";
  chart.series = std::move(series);
  return chart;
}

/// The points of the first line: the first path within a clip.
std::vector<Vec2> first_line(const std::string& svg) {
  const pugi::xml_document document = parsed(svg);
  return polygons(document.select_node("//*[name()='g']/*[name()='path']").node().attribute("d").value())
      .at(0);
}

TEST(Chart, LinesAreAffineImagesOfTheirNumbers) {
  const Series line{"a", {0, 1, 2, 4}, {0.5, -1, 3, 2}};
  const std::vector<Vec2> drawn = first_line(draw({chart_of({line})}, {}));
  ASSERT_EQ(drawn.size(), 4u);
  const double x_scale = (drawn[3].x() - drawn[0].x()) / 4, y_scale = (drawn[2].y() - drawn[1].y()) / 4;
  EXPECT_GT(x_scale, 0);
  EXPECT_LT(y_scale, 0);  // upwards
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(drawn[i].x(), drawn[0].x() + x_scale * line.x[i], 0.02);
    EXPECT_NEAR(drawn[i].y(), drawn[1].y() + y_scale * (line.y[i] + 1), 0.02);
  }
}

TEST(Chart, AxesCarryUnitsWithPrefixAndLinesTheirNames) {
  const std::string told = texts(
      parsed(draw({chart_of({{"first & second", {0, 3}, {0, 2e-3}}, {"third", {0, 3}, {0, 1e-3}}})}, {})));
  EXPECT_NE(told.find("ux (mm)"), std::string::npos) << told;
  EXPECT_NE(told.find("time (s)"), std::string::npos) << told;
  EXPECT_NE(told.find("first & second"), std::string::npos) << told;
}

TEST(Chart, IsSoundWhateverTheNumbers) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  const std::vector<Series> zoo = {{"none", {}, {}},
                                   {"single", {1}, {2}},
                                   {"constant", {0, 1, 2}, {-4e9, -4e9, -4e9}},
                                   {"zero", {0, 1}, {0, 0}},
                                   {"gap", {0, 1, 2, 3}, {0, nan, infinity, 1}},
                                   {"tiny", {0, 1e-9}, {1e-300, 3e-300}},
                                   {"huge", {0, 1e9}, {-1e300, 1e300}},
                                   {"far", {1e6, 1e6 + 1e-3}, {1e9, 1e9 + 2}}};
  for (const Series& series : zoo) {
    SCOPED_TRACE(series.name);
    const std::string svg = draw({chart_of({series}), chart_of({series, series})}, {.title = "zoo"});
    parsed(svg);
    for (const char* wrong : {"nan", "inf", "undefined"})
      EXPECT_EQ(svg.find(wrong), std::string::npos) << wrong;
  }
  EXPECT_THROW(draw(std::vector<Chart>{}, ChartOptions{}), Error);
}

TEST(Chart, ManyLinesAreToldApart) {
  std::vector<Series> lines;
  for (int k = 0; k < 18; ++k) lines.push_back({std::to_string(k), {0, 1}, {0, 1. + k}});
  std::vector<std::string> looks;
  const pugi::xml_document document = parsed(draw({chart_of(lines)}, {}));
  for (const pugi::xpath_node& node : document.select_nodes("//*[name()='g']/*[name()='path']"))
    looks.push_back(std::string(node.node().attribute("stroke").value()) +
                    node.node().attribute("stroke-dasharray").value());
  std::sort(looks.begin(), looks.end());
  EXPECT_EQ(looks.size(), 18u);
  EXPECT_EQ(std::unique(looks.begin(), looks.end()), looks.end());
}

Chart logarithmic(std::vector<Series> series) {
  Chart chart = chart_of(std::move(series));
  chart.x_logarithmic = chart.y_logarithmic = true;
  return chart;
}

TEST(Chart, PowersAreStraightOnLogarithmicAxes) {
  Series line{"a", {}, {}};
  for (const double x : {1e-3, 4e-2, 1., 7e2}) {
    line.x.push_back(x);
    line.y.push_back(1e-5 * x * x);
  }
  const std::vector<Vec2> drawn = first_line(draw({logarithmic({line})}, {}));
  ASSERT_EQ(drawn.size(), 4u);
  const Vec2 whole = drawn[3] - drawn[0];
  for (std::size_t i = 1; i < 3; ++i) {
    const double share = std::log(line.x[i] / line.x[0]) / std::log(line.x[3] / line.x[0]);
    EXPECT_LT((drawn[i] - drawn[0] - share * whole).norm(), 0.02);
  }
}

TEST(Chart, LogarithmicAxesAreMarkedAtPowersOfTenInThePlainUnit) {
  const std::string told = texts(parsed(draw({logarithmic({{"a", {20, 3e4}, {2e-6, 7e-3}}})}, {})));
  for (const char* text : {"10\u00b2", "10\u2074", "10\u207b\u2075", "10\u207b\u00b3", "time (s)", "ux (m)"})
    EXPECT_NE(told.find(text), std::string::npos) << text << " in " << told;
}

TEST(Chart, LogarithmicAxesLeaveOutWhatHasNoLogarithm) {
  const Series line{"a", {1, 2, 0, -1, 10, 20}, {1, 2, 3, 4, 0, 5}};
  const std::string svg =
      draw({logarithmic({line}), logarithmic({{"none", {-1}, {0}}}), logarithmic({})}, {});
  EXPECT_EQ(first_line(svg).size(), 2u);
  for (const char* wrong : {"nan", "inf", "undefined"})
    EXPECT_EQ(svg.find(wrong), std::string::npos) << wrong;
}

TEST(Chart, GuidesTakeNoColourFromTheLines) {
  const Series a{"a", {1, 2}, {1, 2}, false, true}, guide{"guide", {1, 2}, {2, 1}, false, false, true};
  const auto last_stroke = [](const std::vector<Series>& series) {
    const pugi::xml_document document = parsed(draw({chart_of(series)}, {}));
    return std::string(document.select_nodes("//*[name()='g']/*[name()='path'][@stroke]")[series.size() - 1]
                           .node()
                           .attribute("stroke")
                           .value());
  };
  EXPECT_EQ(last_stroke({a, guide, a}), last_stroke({a, a}));
  EXPECT_NE(last_stroke({a, guide}), last_stroke({a, a}));
}

}  // namespace
