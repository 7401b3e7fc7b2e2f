#include <ddacontact/output/frame_file.hpp>
#include <ddacontact/output/frame_mesh.hpp>
#include <ddacontact/output/frame_reader.hpp>
#include <ddacontact/output/output_error.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/io/vtu_reader.hpp>
#include <tests/ddacontact/output/random_frame.hpp>

#include <gtest/gtest.h>

#include <fstream>

using namespace support;
using polyfem::VtuReader;
using polyfem::VtuSection;

namespace {

class FrameFileTest : public testing::Test {
 protected:
  FrameFileTest() { std::filesystem::create_directories(directory); }
  ~FrameFileTest() override { std::filesystem::remove_all(directory); }

  void write(const Frame& frame, const FrameOptions& options) {
    write_blocks(files.blocks, frame, options);
    write_contacts(files.contacts, frame);
  }

  std::filesystem::path directory = std::filesystem::path(testing::TempDir()) /
                                    ("frame_file_test" + std::to_string(std::random_device()()));
  FrameFile files{0, 0, directory / "blocks.vtu", directory / "contacts.vtu"};
};

void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.n_blocks(), b.n_blocks());
  for (int k = 0; k < a.n_blocks(); ++k) {
    EXPECT_EQ(a.blocks[k].first, b.blocks[k].first);
    EXPECT_EQ(a.blocks[k].count, b.blocks[k].count);
  }
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.material_names, b.material_names);
  ASSERT_EQ(a.elasticity.size(), b.elasticity.size());
  for (std::size_t m = 0; m < a.elasticity.size(); ++m) EXPECT_TRUE(same(a.elasticity[m], b.elasticity[m]));
  EXPECT_TRUE(same(a.position, b.position));
  EXPECT_TRUE(same(a.displacement, b.displacement));
  EXPECT_TRUE(same(a.velocity, b.velocity));
  EXPECT_TRUE(same(a.strain_displacement, b.strain_displacement));
  EXPECT_TRUE(same(a.mean_stress, b.mean_stress));
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const FrameContact &p = a.contacts[k], &q = b.contacts[k];
    EXPECT_TRUE(p.vertex_block == q.vertex_block && p.edge_block == q.edge_block && p.state == q.state);
    EXPECT_TRUE(same(p.position, q.position) && same(p.normal, q.normal));
    EXPECT_TRUE(p.gap == q.gap && p.normal_force == q.normal_force && p.shear_force == q.shear_force);
  }
}

TEST_F(FrameFileTest, AFrameIsReadBackBitForBit) {
  for (int n_blocks : {1, 2, 40, 1500})
    for (int refine : {0, 1, 4}) {
      if (n_blocks * refine > 1500) continue;
      const Frame frame = random_frame(n_blocks, 3);
      write(frame, {.refine = refine});
      expect_same(read_frame(files), frame);
    }
}

TEST_F(FrameFileTest, FieldsNotAskedForAreAbsentFromFileAndFrame) {
  for (int mask = 0; mask < 16; ++mask)
    for (int refine : {0, 2}) {
      const FrameOptions options{.displacement = (mask & 1) != 0,
                                 .velocity = (mask & 2) != 0,
                                 .stress = (mask & 4) != 0,
                                 .principal = (mask & 8) != 0,
                                 .refine = refine};
      Frame frame = random_frame(6, 4);
      if (!options.displacement) frame.displacement.resize(2, 0);
      if (!options.velocity) frame.velocity.resize(2, 0);
      if (!options.fields().stress) {
        frame.strain_displacement.resize(2, 0);
        frame.mean_stress.resize(3, 0);
      }
      write(frame, options);
      expect_same(read_frame(files), frame);
      const VtuReader file(files.blocks);
      for (VtuSection section : {VtuSection::point_data, VtuSection::cell_data}) {
        EXPECT_TRUE(file.has(section, "block_id") && file.has(section, "material"));
        EXPECT_EQ(file.has(section, "displacement"), options.displacement);
        EXPECT_EQ(file.has(section, "velocity"), options.velocity);
        for (const char* name : {"sxx", "syy", "sxy"}) EXPECT_EQ(file.has(section, name), options.stress);
        for (const char* name : {"s1", "s2"}) EXPECT_EQ(file.has(section, name), options.principal);
      }
    }
}

/// A block's stress at its corners is that of its shape functions there.
TEST(FrameStress, AtAVertexTheShortFormIsThatOfTheShapeFunctions) {
  const Frame frame = random_frame(300, 5);
  polyfem::ShapeValues shape;
  for (int b = 0; b < frame.n_blocks(); ++b)
    for (int v = 0; v < frame.blocks[b].count; ++v) {
      polyfem::wachspress(frame.outline(b), frame.outline(b).col(v), shape);
      const Vec3 expected = frame.stress(b, shape);
      EXPECT_LE((frame.stress_at_vertex(b, v) - expected).norm(), 1e-8 * expected.norm());
    }
}

TEST(FrameMesh, PolygonsAreSortedByTheirVerticesAndKnowTheirBlocks) {
  const Frame frame = random_frame(50, 6);
  const FrameMesh mesh = draw_outlines(frame);
  std::int64_t begin = 0, last_count = 0;
  std::vector<bool> seen(50, false);
  for (std::size_t cell = 0; cell < mesh.ends.size(); ++cell) {
    const int b = mesh.block_of_cell[cell];
    const std::int64_t count = mesh.ends[cell] - begin;
    EXPECT_EQ(count, frame.blocks[b].count);
    EXPECT_GE(count, last_count);
    EXPECT_FALSE(seen[b]);
    seen[b] = true;
    for (std::int64_t k = 0; k < count; ++k)
      EXPECT_EQ(mesh.points.col(mesh.connectivity[begin + k]).head<2>(), frame.outline(b).col(k));
    EXPECT_EQ(mesh.at_cells.stress.row(static_cast<Index>(cell)).transpose(), frame.mean_stress.col(b));
    begin = mesh.ends[cell];
    last_count = count;
  }
}

TEST(FrameMesh, SubTrianglesCoverEachBlockAndCarryItsFields) {
  const Frame frame = random_frame(8, 7);
  for (int n : {1, 3}) {
    const FrameMesh mesh = draw_sub_triangles(frame, n);
    VectorXd area = VectorXd::Zero(frame.n_blocks());
    polyfem::ShapeValues shape;
    for (Index k = 0; k < mesh.points.cols(); ++k) {
      const int b = mesh.block_of_point[k];
      polyfem::wachspress(frame.outline(b), mesh.points.col(k).head<2>(), shape);
      const auto columns = Eigen::seqN(frame.blocks[b].first, frame.blocks[b].count);
      const Vec3 stress = frame.stress(b, shape);
      EXPECT_LE((mesh.at_points.stress.row(k).transpose() - stress).norm(), 1e-8 * stress.norm());
      const Vec2 u = frame.displacement(Eigen::all, columns) * shape.values,
                 v = frame.velocity(Eigen::all, columns) * shape.values;
      EXPECT_LE((mesh.at_points.displacement.col(k).head<2>() - u).norm(), 1e-11);
      EXPECT_LE((mesh.at_points.velocity.col(k).head<2>() - v).norm(), 1e-11);
      EXPECT_EQ(mesh.points(2, k), 0);
    }
    for (std::size_t cell = 0; cell < mesh.ends.size(); ++cell) {
      Points corners(2, 3);
      for (int k = 0; k < 3; ++k) {
        const auto point = mesh.connectivity[3 * cell + k];
        corners.col(k) = mesh.points.col(point).head<2>();
        EXPECT_EQ(mesh.block_of_point[point], mesh.block_of_cell[cell]);
      }
      const int b = mesh.block_of_cell[cell];
      area[b] += polyfem::signed_area(corners);
      polyfem::wachspress(frame.outline(b), corners.rowwise().mean(), shape);
      const Vec3 stress = frame.stress(b, shape);
      EXPECT_LE((mesh.at_cells.stress.row(static_cast<Index>(cell)).transpose() - stress).norm(),
                1e-6 * stress.norm());
    }
    for (int b = 0; b < frame.n_blocks(); ++b)
      EXPECT_NEAR(area[b], polyfem::signed_area(frame.outline(b)), 1e-8);
  }
}

TEST_F(FrameFileTest, DamagedFilesAreErrorsThatNameThem) {
  const Frame frame = random_frame(12, 8);
  write(frame, {});
  const auto bytes_of = [](const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  std::mt19937 random(9);
  int n_errors = 0;
  for (const auto& path : {files.blocks, files.contacts}) {
    const std::string whole = bytes_of(path);
    for (int k = 0; k < 1500; ++k) {
      std::string damaged = whole;
      if (k % 5 == 0)
        damaged.resize(random() % whole.size());
      else
        damaged[random() % whole.size()] ^= static_cast<char>(1 << (random() % 8));
      std::filesystem::remove(path);  // replacing a file's contents is slow on some file systems
      std::ofstream(path, std::ios::binary) << damaged;
      try {
        read_frame(files);
      } catch (const OutputError& error) {
        ++n_errors;
        EXPECT_NE(std::string(error.what()).find(directory.string()), std::string::npos) << error.what();
      }
    }
    std::ofstream(path, std::ios::binary) << whole;
  }
  EXPECT_GT(n_errors, 1000);
  expect_same(read_frame(files), frame);
}

TEST_F(FrameFileTest, BlocksAndContactsMustBeOfTheSameMoment) {
  Frame frame = random_frame(3, 10);
  write(frame, {});
  frame.time += 1;
  write_contacts(files.contacts, frame);
  EXPECT_THROW(read_frame(files), OutputError);
}

}  // namespace
