#include <polyfem/io/off_file.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/io/line_reader.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace polyfem {

PolygonMesh read_off(const std::filesystem::path& path) {
  LineReader in(path, '#');
  in.require_line("\"OFF\"");
  if (in.word() != "OFF")
    in.fail("an .off file starts with \"OFF\": give one that is ASCII, without normals");
  if (in.rest().empty()) in.require_line("the numbers of vertices, faces and edges");
  const int n_vertices = in.whole_number("the number of vertices");
  const int n_faces = in.whole_number("the number of faces");
  in.whole_number("the number of edges");

  PolygonMesh mesh;
  mesh.vertices.resize(2, n_vertices);
  double z = 0;
  for (int v = 0; v < n_vertices; ++v) {
    in.require_line("vertex " + std::to_string(v));
    for (const int axis : {0, 1}) mesh.vertices(axis, v) = in.number("x, y and z of a vertex");
    const double height = in.number("x, y and z of a vertex");
    if (v == 0) z = height;
    if (std::abs(height - z) > 1e-9 * mesh.vertices.leftCols(v + 1).cwiseAbs().maxCoeff())
      in.fail("vertex " + std::to_string(v) + " is not in the plane of the first one: give all the same z");
  }
  std::vector<int> corners;
  for (int c = 0; c < n_faces; ++c) {
    in.require_line("face " + std::to_string(c));
    corners.resize(static_cast<std::size_t>(in.whole_number("the number of a face's vertices", 3)));
    for (int& v : corners) {
      v = in.whole_number("the number of a vertex, from 0 on");
      if (v >= n_vertices)
        in.fail("face " + std::to_string(c) + " has a vertex " + std::to_string(v) + ", but there are " +
                std::to_string(n_vertices) + ", numbered from 0 on: correct the number");
    }
    mesh.add_cell(corners);
    if (signed_area(mesh.outline(c)) < 0)
      std::reverse(mesh.indices.begin() + mesh.offsets[c], mesh.indices.end());
  }
  return mesh;
}

void write_off(const std::filesystem::path& path, const PolygonMesh& mesh) {
  require_numbering(mesh);
  std::ofstream out(path);
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "OFF\n" << mesh.vertices.cols() << ' ' << mesh.n_cells() << " 0\n";
  for (const auto vertex : mesh.vertices.colwise()) out << vertex.x() << ' ' << vertex.y() << " 0\n";
  for (int c = 0; c < mesh.n_cells(); ++c) {
    out << mesh.cell(c).size();
    for (const int v : mesh.cell(c)) out << ' ' << v;
    out << '\n';
  }
  out.close();
  if (out) return;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw FileError("cannot write \"" + path.string() + "\": see that its directory is there and has room");
}

}  // namespace polyfem
