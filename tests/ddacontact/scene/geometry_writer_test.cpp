// Files are read back by GEOS and by the scene reader.

#include <ddacontact/output/output_error.hpp>
#include <ddacontact/scene/geometry_writer.hpp>
#include <ddacontact/scene/reader.hpp>

#include <geos_c.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace ddacontact;

namespace {

namespace fs = std::filesystem;

/// Two triangles and a square with numbers of many digits; the first two reach down to the lowest level.
std::vector<Points> blocks() {
  Points first(2, 3), second(2, 3), third(2, 4);
  first << 0, 1. / 3, 0, 0, 0, 1e-7;
  second << 1. / 3, 1e6 + 0.1, 1, 0, -0.0, std::nextafter(1, 2);
  third << 3e6, 4e6, 4e6, 3e6, 1, 1, 2e5, 2e5;
  return {first, second, third};
}

class GeometryWriter : public testing::Test {
 protected:
  GeometryWriter() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        fs::temp_directory_path() / ("polydda_" + std::string(test->name()) + std::to_string(getpid()));
    fs::create_directories(directory_);
    geos_ = GEOS_init_r();
  }
  ~GeometryWriter() override {
    GEOS_finish_r(geos_);
    fs::remove_all(directory_);
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string written(const std::string& name) const {
    write_geometry(path(name), blocks(), "three \"blocks\"");
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  /// Takes the geometry.
  void expect_polygon(GEOSGeometry* geometry, const Points& polygon) const {
    ASSERT_TRUE(geometry);
    EXPECT_EQ(GEOSGeomTypeId_r(geos_, geometry), GEOS_POLYGON);
    const GEOSCoordSequence* ring = GEOSGeom_getCoordSeq_r(geos_, GEOSGetExteriorRing_r(geos_, geometry));
    unsigned size = 0;
    GEOSCoordSeq_getSize_r(geos_, ring, &size);
    ASSERT_EQ(size, polygon.cols() + 1);
    for (unsigned k = 0; k < size; ++k) {
      Vec2 x;
      GEOSCoordSeq_getXY_r(geos_, ring, k, &x.x(), &x.y());
      EXPECT_EQ(x, Vec2(polygon.col(k % polygon.cols())));
    }
    GEOSGeom_destroy_r(geos_, geometry);
  }

  fs::path directory_;
  GEOSContextHandle_t geos_;
};

TEST_F(GeometryWriter, WktHasAPolygonALineToTheBit) {
  std::istringstream lines(written("a.wkt"));
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos_);
  std::string line;
  for (const Points& polygon : blocks()) {
    ASSERT_TRUE(std::getline(lines, line));
    expect_polygon(GEOSWKTReader_read_r(geos_, reader, line.c_str()), polygon);
    EXPECT_EQ(line.find("-0 "), std::string::npos);
    EXPECT_EQ(line.find("-0,"), std::string::npos);
  }
  EXPECT_FALSE(std::getline(lines, line));
  GEOSWKTReader_destroy_r(geos_, reader);
}

TEST_F(GeometryWriter, GeojsonIsAFeatureCollectionToTheBit) {
  const std::string text = written("a.geojson");
  EXPECT_EQ(text.rfind("{\"type\": \"FeatureCollection\"", 0), 0u);
  GEOSGeoJSONReader* reader = GEOSGeoJSONReader_create_r(geos_);
  GEOSGeometry* collection = GEOSGeoJSONReader_readGeometry_r(geos_, reader, text.c_str());
  ASSERT_TRUE(collection);
  ASSERT_EQ(GEOSGetNumGeometries_r(geos_, collection), 3);
  for (int i = 0; i < 3; ++i)
    expect_polygon(GEOSGeom_clone_r(geos_, GEOSGetGeometryN_r(geos_, collection, i)), blocks()[i]);
  GEOSGeom_destroy_r(geos_, collection);
  GEOSGeoJSONReader_destroy_r(geos_, reader);
}

TEST_F(GeometryWriter, TomlIsASceneWithoutErrorsWhoseLowestBlocksAreHeld) {
  written("a.toml");
  // One block is so large that its weight deforms it: the reader warns.
  const SceneReading reading = read_scene(path("a.toml"));
  for (const Problem& problem : reading.problems)
    if (problem.severity == Problem::Severity::error) ADD_FAILURE() << problem.text();
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->title, "three \"blocks\"");
  ASSERT_EQ(reading.scene->blocks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(reading.scene->blocks[i].vertices, blocks()[i]) << i;
  EXPECT_TRUE(reading.scene->blocks[0].fixed);
  EXPECT_TRUE(reading.scene->blocks[1].fixed);
  EXPECT_FALSE(reading.scene->blocks[2].fixed);
}

TEST_F(GeometryWriter, RefusesUnknownEndingsByNamingTheKnownOnes) {
  for (const char* name : {"a", "a.json", "a.TOML", "geojson", "a.wkt.gz"}) try {
      write_geometry(path(name), blocks(), "");
      ADD_FAILURE() << name;
    } catch (const OutputError&) {
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      for (const char* known : {".geojson", ".wkt", ".toml", name})
        EXPECT_NE(std::string(error.what()).find(known), std::string::npos) << error.what();
    }
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(GeometryWriter, SaysWhichFileItCannotWrite) {
  try {
    write_geometry(path("missing/a.wkt"), blocks(), "");
    ADD_FAILURE();
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("missing/a.wkt"), std::string::npos);
  }
}

}  // namespace
