#include <ddacontact/output/cell_pieces.hpp>
#include <ddacontact/output/frame_file.hpp>
#include <ddacontact/output/frame_mesh.hpp>
#include <ddacontact/output/frame_reader.hpp>
#include <ddacontact/output/output_error.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/io/vtu_reader.hpp>
#include <tests/ddacontact/output/cell_frames.hpp>

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
  EXPECT_TRUE(same(a.stress_offset, b.stress_offset));
  EXPECT_TRUE(same(a.mean_stress, b.mean_stress));
  ASSERT_EQ(a.block_values.size(), b.block_values.size());
  for (const auto& [name, values] : a.block_values) EXPECT_TRUE(same(values, b.block_values.at(name)));
  EXPECT_EQ(a.corner_points, b.corner_points);
  ASSERT_EQ(a.n_cells(), b.n_cells());
  for (std::size_t c = 0; c < a.cells.size(); ++c) {
    const FrameCell &p = a.cells[c], &q = b.cells[c];
    EXPECT_TRUE(p.block == q.block && p.elasticity == q.elasticity && p.basis == q.basis);
    EXPECT_TRUE(p.corners.first == q.corners.first && p.corners.count == q.corners.count);
  }
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

TEST_F(FrameFileTest, CellsAreReadBackBitForBit) {
  for (int refine : {0, 1, 3})
    for (unsigned seed : {1u, 2u}) {
      const Frame frame = random_cell_frame(seed);
      write(frame, {.refine = refine});
      expect_same(read_frame(files), frame);
      Frame moving = frame;
      moving.strain_displacement.resize(2, 0);
      moving.stress_offset.resize(3, 0);
      moving.mean_stress.resize(3, 0);
      for (FrameCell& cell : moving.cells) cell.elasticity = moving.materials[cell.block];
      write(moving, {.stress = false, .principal = false, .refine = refine});
      expect_same(read_frame(files), moving);
    }
}

/// Files of blocks that are one Wachspress cell hold nothing of cells.
TEST_F(FrameFileTest, OutlinesAreNotToldOfAsCells) {
  write(random_frame(5, 11), {});
  EXPECT_FALSE(VtuReader(files.blocks).has(VtuSection::field_data, "n_places"));
  write(cell_frame(), {.displacement = false, .velocity = false, .stress = false, .principal = false});
  EXPECT_TRUE(VtuReader(files.blocks).has(VtuSection::field_data, "n_places"));
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
        frame.stress_offset.resize(3, 0);
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

TEST(FrameMesh, PolygonsAreSortedByTheirVerticesAndKnowTheirBlocks) {
  const Frame frame = random_frame(50, 6);
  const FrameMesh mesh = draw_cells(frame);
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

/// The areas of the drawn cells by blocks; none is turned over.
VectorXd drawn_areas(const FrameMesh& mesh, int n_blocks) {
  VectorXd areas = VectorXd::Zero(n_blocks);
  std::int64_t begin = 0;
  for (std::size_t cell = 0; cell < mesh.ends.size(); ++cell) {
    Points corners(2, mesh.ends[cell] - begin);
    for (Index k = 0; k < corners.cols(); ++k) {
      corners.col(k) = mesh.points.col(mesh.connectivity[begin + k]).head<2>();
      EXPECT_EQ(mesh.block_of_point[mesh.connectivity[begin + k]], mesh.block_of_cell[cell]);
    }
    EXPECT_GT(polyfem::signed_area(corners), 0);
    areas[mesh.block_of_cell[cell]] += polyfem::signed_area(corners);
    begin = mesh.ends[cell];
  }
  return areas;
}

TEST(FrameMesh, SubTrianglesCoverEachBlockAndCarryItsFields) {
  const Frame frame = random_frame(8, 7);
  for (int n : {1, 3}) {
    const FrameMesh mesh = draw_sub_triangles(frame, n);
    polyfem::ShapeValues shape;
    for (Index k = 0; k < mesh.points.cols(); ++k) {
      const int b = mesh.block_of_point[k];
      const Vec2 point = mesh.points.col(k).head<2>(), centre = centre_of(frame.outline(b));
      polyfem::wachspress(frame.outline(b), stress_place(centre, point), shape);
      const Vec3 stress = CellView(frame, b).stress(shape);
      polyfem::wachspress(frame.outline(b), point, shape);
      const auto columns = Eigen::seqN(frame.blocks[b].first, frame.blocks[b].count);
      EXPECT_LE((mesh.at_points.stress.row(k).transpose() - stress).norm(), 1e-8 * stress.norm());
      const Vec2 u = frame.displacement(Eigen::all, columns) * shape.values,
                 v = frame.velocity(Eigen::all, columns) * shape.values;
      EXPECT_LE((mesh.at_points.displacement.col(k).head<2>() - u).norm(), 1e-11);
      EXPECT_LE((mesh.at_points.velocity.col(k).head<2>() - v).norm(), 1e-11);
      EXPECT_EQ(mesh.points(2, k), 0);
    }
    const VectorXd areas = drawn_areas(mesh, frame.n_blocks());
    for (int b = 0; b < frame.n_blocks(); ++b)
      EXPECT_NEAR(areas[b], polyfem::signed_area(frame.outline(b)), 1e-8);
  }
}

/// What is drawn of a frame: points and cells with the corners of each.
void expect_linear(const Frame& frame, const FrameMesh& mesh, const Mat2& gradient, const Vec3& offset) {
  const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  const auto stress = [&](int c) -> Vec3 {
    return frame.elasticity[frame.cells[c].elasticity] * strain + c * offset;
  };
  const auto expect_of_a_cell = [&](int block, const Vec3& found) {
    double nearest = 1e300;
    for (int c = 0; c < frame.n_cells(); ++c)
      if (frame.cells[c].block == block)
        nearest = std::min(nearest, (found - stress(c)).norm() / stress(c).norm());
    EXPECT_LE(nearest, 1e-11);
  };
  for (Index k = 0; k < mesh.points.cols(); ++k) {
    const Vec2 u = gradient * mesh.points.col(k).head<2>();
    EXPECT_LE((mesh.at_points.displacement.col(k).head<2>() - u).norm(), 1e-16);
    EXPECT_LE((mesh.at_points.velocity.col(k).head<2>() - u).norm(), 1e-16);
    EXPECT_LE((mesh.at_points.strain_displacement.col(k) - u).norm(), 1e-16);
    expect_of_a_cell(mesh.block_of_point[k], mesh.at_points.stress.row(k));
  }
  for (std::size_t k = 0; k < mesh.ends.size(); ++k)
    expect_of_a_cell(mesh.block_of_cell[k], mesh.at_cells.stress.row(static_cast<Index>(k)));
  for (int c = 0; c < frame.n_cells(); ++c)
    for (int k = 0; k < frame.cells[c].corners.count; ++k) {
      const int corner = frame.cells[c].corners.first + k, point = mesh.corner_point[corner];
      EXPECT_EQ(mesh.points.col(point).head<2>(), frame.position.col(frame.corner_points[corner]));
      const Vec3 found = mesh.at_points.stress.row(point);
      EXPECT_LE((found - stress(c)).norm(), 1e-11 * stress(c).norm());
    }
}

TEST(FrameMesh, ConcaveAndDividedBlocksAreFilledByTheirCellsWithLinearFieldsExact) {
  const Mat2 gradient = (Mat2() << 1e-3, -3e-4, 2e-4, -5e-4).finished();
  const Vec3 offset(3e5, -1e5, 2e5);
  const Frame frame = linear_cell_frame(gradient, offset);
  for (int n : {0, 1, 2, 5}) {
    const FrameMesh mesh = n == 0 ? draw_cells(frame) : draw_sub_triangles(frame, n);
    expect_linear(frame, mesh, gradient, offset);
    const VectorXd areas = drawn_areas(mesh, frame.n_blocks());
    for (int b = 0; b < frame.n_blocks(); ++b)
      EXPECT_NEAR(areas[b], polyfem::signed_area(frame.outline(b)), 1e-12);
  }
}

TEST(FrameMesh, PolygonsOfADividedBlockHaveTheirMeanStress) {
  const Frame frame = random_cell_frame(12);
  const FrameMesh polygons = draw_cells(frame), triangles = draw_sub_triangles(frame, 60);
  // Averages of fine triangles by the polygons of cells: in the block of several cells.
  for (std::size_t k = 0; k < polygons.ends.size(); ++k) {
    if (polygons.block_of_cell[k] != 3) continue;
    const std::int64_t begin = k == 0 ? 0 : polygons.ends[k - 1];
    Points cell(2, polygons.ends[k] - begin);
    for (Index i = 0; i < cell.cols(); ++i)
      cell.col(i) = polygons.points.col(polygons.connectivity[begin + i]).head<2>();
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (std::size_t t = 0; t < triangles.ends.size(); ++t) {
      Points corners(2, 3);
      for (int i = 0; i < 3; ++i)
        corners.col(i) = triangles.points.col(triangles.connectivity[3 * t + i]).head<2>();
      if (!polyfem::contains(cell, corners.rowwise().mean())) continue;
      area += polyfem::signed_area(corners);
      sum += polyfem::signed_area(corners) * triangles.at_cells.stress.row(static_cast<Index>(t)).transpose();
    }
    EXPECT_NEAR(area, polyfem::signed_area(cell), 1e-9);
    const Vec3 mean = polygons.at_cells.stress.row(static_cast<Index>(k));
    EXPECT_LE((sum / area - mean).norm(), 1e-3 * mean.norm());
  }
}

TEST(CellView, AWachspressCellThatTurnedConcaveIsDrawnAllTheSame) {
  const Mat2 gradient = (Mat2() << 1e-3, -3e-4, 2e-4, -5e-4).finished();
  Frame frame = linear_cell_frame(gradient, Vec3::Zero());
  for (const Vec2& corner : {Vec2(0.4, 0.4), Vec2(0.5, 0.5)}) {  // concave, straight
    frame.position.col(2) = corner;
    frame.strain_displacement.col(2) = gradient * corner;
    const CellView view(frame, 0);
    EXPECT_EQ(&view.basis(), &polyfem::mean_value);
    const Vec3 expected = frame.elasticity[0] * Vec3(1e-3, -5e-4, -1e-4);
    polyfem::ShapeValues shape;
    view.basis()(view.corners(), Vec2(0.2, 0.3), shape);
    EXPECT_LE((view.stress(shape) - expected).norm(), 1e-11 * expected.norm());
    EXPECT_LE((view.mean_stress() - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST_F(FrameFileTest, DamagedFilesAreErrorsThatNameThem) {
  const Frame frame = random_cell_frame(8);
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
