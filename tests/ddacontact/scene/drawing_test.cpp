/// \file Drawings: DXF and Shi's geometry files as blocks and as domains, and what is refused of them.
#include "geometry_scenes.hpp"

#include <ddacontact/scene/geometry_writer.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <fstream>
#include <sstream>

namespace {

using namespace geometry_scenes;
using polyfem::signed_area;

/// Group codes and values, one pair after the other.
std::string groups(std::initializer_list<std::pair<int, std::string>> pairs) {
  std::string text;
  for (const auto& [code, value] : pairs) text += std::to_string(code) + '\n' + value + '\n';
  return text;
}

const std::string rectangle = groups({{0, "LWPOLYLINE"},
                                      {8, "site"},
                                      {90, "4"},
                                      {70, "1"},
                                      {10, "0"},
                                      {20, "0"},
                                      {10, "10"},
                                      {20, "0"},
                                      {10, "10"},
                                      {20, "6"},
                                      {10, "0"},
                                      {20, "6"}});
const std::string line = groups({{0, "LINE"}, {8, "weak"}, {10, "3"}, {20, "0"}, {11, "7"}, {21, "6"}});

std::string dxf(const std::string& entities) {
  return groups({{0, "SECTION"}, {2, "ENTITIES"}}) + entities + groups({{0, "ENDSEC"}, {0, "EOF"}});
}

class Drawings : public GeometryScenes {
 protected:
  /// The scene with the file as the boundary of its domain.
  SceneReading domain_of(const std::string& name, const std::string& text) const {
    write(name, text);
    return read_here(std::string(without_blocks) +
                     "[[joint]]\nname = \"usual\"\n[[joint]]\nname = \"weak\"\n[domain]\nboundary = \"" +
                     name + "\"\n");
  }
  SceneReading read_here(const std::string& text) const {
    return ddacontact::read_scene_text(text, "scene.toml", {}, directory_);
  }
};

TEST_F(Drawings, OfLinesInSpaceAreWarnedOf) {
  const auto said = [&](const char* z) {
    return all_text(domain_of("a.dxf", dxf(rectangle + line + groups({{30, "5"}, {31, z}}))).problems);
  };
  EXPECT_NE(said("9").find("out of the plane x-y run 1 of the lines: z is left out"), std::string::npos)
      << said("9");
  EXPECT_EQ(said("5").find("out of the plane"), std::string::npos);
}

TEST_F(Drawings, ClosedLinesOfDxfAreBlocks) {
  const Scene scene = scene_with("a.dxf", dxf(rectangle));
  ASSERT_EQ(scene.blocks.size(), 1u);
  EXPECT_EQ(scene.blocks[0].vertices.col(2), ddacontact::Vec2(10, 6));
  EXPECT_EQ(scene.blocks[0].groups, std::vector<std::string>{"site"});
}

TEST_F(Drawings, LinesOfDxfCutTheDomainByTheLawOfTheirLayer) {
  const SceneReading reading = domain_of("a.dxf", dxf(rectangle + line));
  ASSERT_TRUE(reading.scene) << all_text(reading.problems);
  ASSERT_EQ(reading.scene->blocks.size(), 2u);
  EXPECT_EQ(reading.scene->blocks[0].edge_joints, (std::vector{-1, 1, -1, -1}));
}

TEST_F(Drawings, PolylinesOfOldFilesAndArcsAreRead) {
  const std::string polyline = groups({{0, "POLYLINE"},
                                       {8, "0"},
                                       {66, "1"},
                                       {70, "0"},
                                       {0, "VERTEX"},
                                       {10, "0"},
                                       {20, "3"},
                                       {42, "-1"},
                                       {0, "VERTEX"},
                                       {10, "10"},
                                       {20, "3"},
                                       {0, "SEQEND"}});  // a half circle above: beyond the domain
  const std::string circle = groups({{0, "CIRCLE"}, {8, "0"}, {10, "5"}, {20, "3"}, {40, "1"}});
  EXPECT_EQ(domain_of("a.dxf", dxf(rectangle + polyline)).scene.value().blocks.size(), 3u);
  EXPECT_EQ(domain_of("b.dxf", dxf(rectangle + circle)).scene.value().blocks.size(), 3u);
  const std::string arc =
      groups({{0, "ARC"}, {8, "0"}, {10, "0"}, {20, "0"}, {40, "4"}, {50, "0"}, {51, "90"}});
  const Scene corner = domain_of("c.dxf", dxf(rectangle + arc)).scene.value();
  ASSERT_EQ(corner.blocks.size(), 2u);
  EXPECT_NEAR(signed_area(corner.blocks[0].vertices), 4 * 3.14159265, 0.2);
}

TEST_F(Drawings, WhatIsSkippedIsTold) {
  const SceneReading reading = domain_of(
      "a.dxf", dxf(rectangle + groups({{0, "TEXT"}, {8, "0"}, {10, "1"}, {20, "1"}, {1, "hello"}})));
  ASSERT_TRUE(reading.scene);
  EXPECT_NE(all_text(reading.problems).find("skipped: 1 TEXT"), std::string::npos)
      << all_text(reading.problems);
}

TEST_F(Drawings, BadDxfIsRefusedWithItsLine) {
  const auto expect = [&](const std::string& text, const std::string& problem) {
    const SceneReading reading = domain_of("a.dxf", text);
    EXPECT_FALSE(reading.scene);
    EXPECT_NE(all_text(reading.problems).find(problem), std::string::npos) << all_text(reading.problems);
  };
  expect("AutoCAD Binary DXF\r\n", "a.dxf:1:1: error: 'AutoCAD Binary DXF' is no group code");
  expect(groups({{0, "SECTION"}, {2, "ENTITIES"}}) + rectangle, "the file ends within its entities");
  expect(groups({{0, "SECTION"}, {2, "ENTITIES"}}) + rectangle + "0",
         ":29:1: error: the file ends within a group");
  expect(dxf(groups({{0, "LINE"}, {10, "x"}})), "a.dxf:8:1: error: 'x' is no number");
  expect(dxf(line), "the drawing has no closed line");
  expect(groups({{0, "EOF"}}), "no section ENTITIES");
  expect("", "no section ENTITIES");
  expect(dxf(rectangle + groups({{0, "LINE"}, {10, "0"}, {20, "0"}, {11, "3"}})),
         ":30:1: error: the LINE has no group 21");
  expect(dxf(rectangle + groups({{0, "CIRCLE"}, {10, "0"}, {20, "0"}})), "the CIRCLE has no group 40");
  expect(dxf(rectangle + groups({{0, "CIRCLE"}, {10, "0"}, {20, "0"}, {40, "-1"}})),
         "radius of the CIRCLE is not positive");
  expect(dxf(rectangle + groups({{0, "ARC"}, {10, "0"}, {20, "0"}, {40, "1"}, {50, "0"}})),
         "the ARC has no group 51");
  expect(dxf(groups({{0, "LWPOLYLINE"}, {70, "1"}, {10, "0"}, {20, "0"}, {10, "4"}, {10, "4"}, {20, "4"}})),
         ":6:1: error: vertex 1 of the LWPOLYLINE has no group 20");
  expect(dxf(groups({{0, "POLYLINE"}, {70, "1"}, {0, "VERTEX"}, {10, "0"}, {0, "SEQEND"}})),
         "the VERTEX has no group 20");
  expect(dxf(rectangle + groups({{230, "-1"}})), "the LWPOLYLINE is drawn mirrored");
}

TEST_F(Drawings, EachKindThatIsSkippedIsCounted) {
  const std::string surface =
      groups({{0, "POLYLINE"}, {70, "64"}, {0, "VERTEX"}, {10, "0"}, {20, "0"}, {0, "SEQEND"}});
  const std::string on_paper = groups({{0, "LINE"}, {67, "1"}, {10, "0"}, {20, "0"}, {11, "3"}, {21, "0"}});
  const std::string spline = groups({{0, "SPLINE"}, {8, "0"}});
  const SceneReading reading = domain_of("a.dxf", dxf(rectangle + surface + on_paper + spline + spline));
  ASSERT_TRUE(reading.scene) << all_text(reading.problems);
  EXPECT_NE(all_text(reading.problems)
                .find("skipped: 1 LINE of the paper space, 1 POLYLINE of a surface, 2 SPLINE"),
            std::string::npos)
      << all_text(reading.problems);
}

TEST_F(Drawings, FilesOfShiAreDomains) {
  const SceneReading reading = domain_of("a.geo",
                                         "0.01\n5 4\n0 0\n0 0 0 0\n0 0 10 0 1\n10 6 10 0 1\n10 6 0 6.001 1\n"
                                         "0 6 0 0 1\n3 -1 7 7 2\n");
  ASSERT_TRUE(reading.scene) << all_text(reading.problems);
  ASSERT_EQ(reading.scene->blocks.size(), 2u);
  EXPECT_EQ(reading.scene->blocks[0].edge_joints, (std::vector{-1, 1, -1, -1}));
}

TEST_F(Drawings, BadFilesOfShiAreRefusedWithTheirLine) {
  const auto expect = [&](const std::string& text, const std::string& problem) {
    const SceneReading reading = domain_of("a.geo", text);
    EXPECT_FALSE(reading.scene);
    EXPECT_NE(all_text(reading.problems).find(problem), std::string::npos) << all_text(reading.problems);
  };
  expect("0.01\n5 4\nx", "a.geo:3:1: error: 'x' is no number");
  expect("0.01\n1 1\n0 0\n0 0 0 0\n0 0 10 0 1\n", "the boundary lines do not close");
  expect("0.01\n1 1\n0 0\n0 0 0 0\n0 0", "the file ends too early");
  expect("0.01\n1 2\n0 0\n0 0 0 0\n", "more boundary lines than lines");
  expect("", "a.geo:1:1: error: the file ends too early");
  expect("-1\n4 4\n", "a.geo:1:1: error: the least distance of vertices is negative");
  expect("0.01\n4.5 4\n", "a.geo:2:1: error: the number of joint lines is no count");
  const std::string lines = "0 0 10 0 1\n10 0 10 5 1\n10 5 0 5 1\n0 5 0 0 1\n";
  expect("0.01\n4 4\n0 0\n1 0 0 0\n" + lines,
         "a.geo:9:1: error: the file ends too early (expected x1 y1 x2 y2 of a fixed");
  expect("0.01\n4 4\n0 0\n0 0 1 0\n" + lines + "3 nan\n", "a.geo:9:3: error: 'nan");
  const SceneReading longer = domain_of("a.geo", "0.01\n4 4\n0 0\n0 0 0 0\n" + lines + "7 7\n");
  EXPECT_NE(all_text(longer.problems).find("skipped: what follows the last item"), std::string::npos);
  const SceneReading analysis = domain_of("a.ana", "0\n20\n1\n3\n");
  EXPECT_NE(all_text(analysis.problems).find("Shi's analysis file is not read"), std::string::npos);
}

TEST_F(Drawings, WrittenDxfReadsBackToTheBit) {
  const Scene scene = scene_with("a.wkt", "POLYGON ((0.1 0.3, 1.7 0, 1 5e1, 0.1 0.3))");
  ddacontact::write_blocks(path("b.dxf"), scene, 0);
  std::ifstream file(path("b.dxf"));
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(scene_with("c.dxf", text.str()).blocks[0].vertices, scene.blocks[0].vertices);
}

/// A T of three bricks, drawn to centimetres: gaps and overlaps of up to 1 cm.
constexpr std::string_view rounded =
    "POLYGON ((0 0, 4 0, 4 1, 0 1, 0 0)) POLYGON ((0 1.01, 1.33 0.99, 1.33 2, 0 2, 0 1.01))"
    "POLYGON ((1.34 0.99, 4 1, 4 2, 1.33 2, 1.34 0.99))";

TEST_F(Drawings, SnappingMakesRoundedBlocksTouch) {
  write("a.wkt", rounded);
  const std::string text = "blocks = \"a.wkt\"\n" + std::string(without_blocks);
  EXPECT_FALSE(read_here(text).scene) << "overlaps by 1 cm";
  const SceneReading reading = read_here("snap = \"2 cm\"\n" + text);
  ASSERT_TRUE(reading.scene) << all_text(reading.problems);
  const auto& blocks = reading.scene->blocks;
  EXPECT_EQ(blocks[1].vertices(1, 1), 1);  // on the lower brick
  EXPECT_EQ(blocks[1].vertices.col(1), blocks[2].vertices.col(0));
  EXPECT_EQ(blocks[1].vertices.col(0), blocks[0].vertices.col(3));
  ASSERT_TRUE(reading.scene->snapped);
  EXPECT_EQ(reading.scene->snapped->moved, 3);
  EXPECT_NEAR(reading.scene->snapped->farthest, 0.014, 0.005);
}

TEST_F(Drawings, SnappingTakesNoVertexAway) {
  write("a.wkt", rounded);
  const SceneReading reading = read_here("snap = 1.5\nblocks = \"a.wkt\"\n" + std::string(without_blocks));
  EXPECT_FALSE(reading.scene);
  EXPECT_NE(all_text(reading.problems).find("nearer than 'snap' = '1.5' m"), std::string::npos);
}

}  // namespace
