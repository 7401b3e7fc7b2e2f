#include <polyfem/core/error.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/io/vtu_reader.hpp>
#include <polyfem/mesh/generators.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

TEST(MeshFile, HoldsTheMeshAndItsFields) {
  const PolygonMesh mesh = hexagons({0, 0}, {2, 1}, 4, 3);
  const Index n = mesh.vertices.cols();
  const VectorXd height = mesh.vertices.row(1);
  const Points turned = (Mat2() << 0, -1, 1, 0).finished() * mesh.vertices;
  const Tensors stress = Tensors::Constant(3, mesh.n_cells(), 2.5);

  MeshFile file(mesh);
  file.add_vertex_field("height", height);
  file.add_vertex_field("turned", turned);
  file.add_vertex_field("interleaved", VectorXd(turned.reshaped()));
  file.add_cell_field("stress", stress);
  const auto path = std::filesystem::path(testing::TempDir()) / "mesh_file_test.vtu";
  file.write(path);

  const VtuReader reader(path);
  EXPECT_EQ(reader.n_points(), static_cast<std::size_t>(n));
  EXPECT_EQ(reader.n_cells(), static_cast<std::size_t>(mesh.n_cells()));
  const std::vector<double> points = reader.points();
  const auto vectors = reader.read<double>(VtuSection::point_data, "turned", 3);
  for (Index v = 0; v < n; ++v) {
    const std::size_t k = 3 * static_cast<std::size_t>(v);
    EXPECT_EQ(Eigen::Vector3d(points[k], points[k + 1], points[k + 2]),
              Eigen::Vector3d(mesh.vertices(0, v), mesh.vertices(1, v), 0));
    EXPECT_EQ(Eigen::Vector3d(vectors[k], vectors[k + 1], vectors[k + 2]),
              Eigen::Vector3d(turned(0, v), turned(1, v), 0));
  }
  EXPECT_EQ(reader.read<double>(VtuSection::point_data, "height"),
            std::vector<double>(height.begin(), height.end()));
  EXPECT_EQ(reader.read<double>(VtuSection::point_data, "interleaved", 3), vectors);
  EXPECT_EQ(reader.read<double>(VtuSection::cell_data, "stress", 3),
            std::vector<double>(3 * static_cast<std::size_t>(mesh.n_cells()), 2.5));
  std::filesystem::remove(path);
}

TEST(MeshFile, RefusesAFieldThatDoesNotFit) {
  const PolygonMesh mesh = rectangles({0, 0}, {1, 1}, 2, 2);
  MeshFile file(mesh);
  EXPECT_THROW(file.add_vertex_field("short", VectorXd::Zero(8)), Error);
  EXPECT_THROW(file.add_cell_field("none", VectorXd()), Error);
  EXPECT_THROW(file.write("/nowhere/at/all.vtu"), FileError);
}

}  // namespace
