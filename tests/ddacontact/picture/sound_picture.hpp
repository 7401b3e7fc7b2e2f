/// \file Two blocks under stress, and what every picture of them has.
#pragma once

#include "frames.hpp"

#include <ddacontact/picture/picture.hpp>

namespace support {

inline const Mat2 stretch_x = (Mat2() << 1e-3, 0, 0, 0).finished();

/// Two unit squares under 1 MPa and -2 MPa of sxx.
inline Frame two_blocks() {
  Frame frame = empty_frame();
  add_block(frame, box(0, 0, 1, 1), stretch_x);
  add_block(frame, box(2, 0, 1, 1), -2 * stretch_x);
  return frame;
}

inline PictureOptions everything() {
  PictureOptions options;
  options.title = "All <there> & \"is\"";
  options.reference = options.names = true;
  options.vectors = {VectorKind::principal_stresses, VectorKind::contact_forces, VectorKind::displacement,
                     VectorKind::velocity};
  return options;
}

/// The polygons of the path with that fill.
inline std::vector<std::vector<Vec2>> filled(const pugi::xml_document& document, const Colour& colour) {
  for (const pugi::xml_node& path : paths(document))
    if (path.attribute("fill").value() == hex(colour)) return polygons(path.attribute("d").value());
  return {};
}

/// The polygons of the block outlines: the only dark strokes with round joins.
inline std::vector<std::vector<Vec2>> outlines(const pugi::xml_document& document) {
  const auto path =
      document.select_node("//*[name()='path'][@stroke='#222'][@stroke-linejoin='round']").node();
  return polygons(path.attribute("d").value());
}

inline void expect_sound(const std::string& svg) {
  const pugi::xml_document document = parsed(svg);
  const pugi::xml_node root = document.document_element();
  const double width = root.attribute("width").as_double(), height = root.attribute("height").as_double();
  EXPECT_GT(width, 100);
  EXPECT_LT(width, 2000);
  EXPECT_LT(height, 3000);
  for (const pugi::xml_node& path : paths(document)) {
    const std::string data = path.attribute("d").value();
    EXPECT_EQ(data.find_first_not_of("mz-. 0123456789"), std::string::npos) << data.substr(0, 80);
    for (const auto& polygon : polygons(data))
      for (const Vec2& x : polygon) {
        EXPECT_TRUE(x.x() >= -1 && x.x() <= width + 1) << x.transpose();
        EXPECT_TRUE(x.y() >= -1 && x.y() <= height + 1) << x.transpose();
      }
  }
  for (const char* wrong : {"nan", "inf", "undefined"})
    EXPECT_EQ(svg.find(wrong), std::string::npos) << wrong;
}

}  // namespace support
