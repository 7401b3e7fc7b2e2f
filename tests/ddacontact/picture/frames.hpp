/// \file Frames filled by hand, and what is read off a picture.
#pragma once

#include <ddacontact/output/frame.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace support {

using namespace ddacontact;

/// Adds a block whose displacement, velocity and straining displacement are `gradient` * x.
inline void add_block(Frame& frame, const Points& outline, const Mat2& gradient, int material = 0) {
  const auto first = static_cast<int>(frame.position.cols());
  const auto n = static_cast<int>(outline.cols());
  frame.blocks.push_back({first, n});
  frame.materials.push_back(material);
  const Points moved = gradient * outline;
  for (Points* columns :
       {&frame.position, &frame.displacement, &frame.velocity, &frame.strain_displacement}) {
    columns->conservativeResize(2, first + n);
    columns->rightCols(n) = columns == &frame.position ? outline : moved;
  }
  frame.add_outline_cell(frame.n_blocks() - 1);
  frame.stress_offset.setZero(3, frame.n_cells());
  const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  frame.mean_stress.conservativeResize(3, frame.n_blocks());
  frame.mean_stress.rightCols(1) = frame.elasticity[0] * strain;
}

inline Frame empty_frame() {
  Frame frame;
  frame.step = 7;
  frame.time = 0.25;
  frame.material_names = {"rock"};
  frame.elasticity = {polyfem::elasticity_matrix(1e9, 0, polyfem::Plane::stress)};
  frame.position.resize(2, 0);
  frame.displacement = frame.velocity = frame.strain_displacement = frame.position;
  frame.mean_stress.resize(3, 0);
  return frame;
}

/// Corners of an axis-parallel rectangle.
inline Points box(double x, double y, double width, double height) {
  Points p(2, 4);
  p << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return p;
}

/// Bricks in rows, each with a field of its own that varies inside.
inline Frame wall(int columns, int rows, double size = 1, const Vec2& corner = Vec2::Zero()) {
  Frame frame = empty_frame();
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const Vec2 at = corner + size * Vec2(i + 0.5 * (j % 2), 0.5 * j);
      add_block(frame, box(at.x(), at.y(), size, 0.5 * size), Mat2::Zero());
      Points bent(2, 4);
      bent << 0, 1 + i, -1. - j, 0.5,  //
          0.25, -i, 2, j;
      for (Points* columns_of : {&frame.displacement, &frame.velocity, &frame.strain_displacement})
        columns_of->rightCols(4) = 1e-3 * size * bent;
    }
  return frame;
}

inline pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(svg.c_str(), pugi::parse_full);
  EXPECT_TRUE(result) << result.description() << " at " << result.offset;
  EXPECT_STREQ(document.document_element().name(), "svg");
  return document;
}

/// The polygons and lines of a path, in pixels.
inline std::vector<std::vector<Vec2>> polygons(const std::string& data) {
  std::string spaced;
  for (const char c : data) {
    if (c == '-' || c == 'm' || c == 'z') spaced += ' ';
    spaced += c;
    if (c == 'm' || c == 'z') spaced += ' ';
  }
  std::vector<std::vector<Vec2>> all;
  Vec2 pen(0, 0);
  std::istringstream words(spaced);
  for (std::string word; words >> word;) {
    if (word == "m") {
      all.emplace_back();
    } else if (word == "z") {
      pen = all.back().front();
    } else {
      double y = 0;
      words >> y;
      pen += Vec2(std::stod(word), y);
      all.back().push_back(pen);
    }
  }
  return all;
}

inline double area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

/// All paths of a picture, in the order they are painted.
inline std::vector<pugi::xml_node> paths(const pugi::xml_document& document) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xpath_node& node : document.select_nodes("//*[name()='path']"))
    found.push_back(node.node());
  return found;
}

/// The texts of a picture, one a line, indices in line.
inline std::string texts(const pugi::xml_document& document) {
  std::string all;
  for (const pugi::xpath_node& node : document.select_nodes("//*[name()='text']")) {
    for (const pugi::xml_node child : node.node().children())
      all += child.type() == pugi::node_pcdata ? child.value() : child.child_value();
    all += '\n';
  }
  return all;
}

}  // namespace support
