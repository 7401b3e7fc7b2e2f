#include <polyfem/io/vtu_mesh.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/io/vtu_arrays.hpp>

#include <algorithm>
#include <set>

namespace polyfem {
namespace {

void read_vertices(const VtuArrays& file, PolygonMesh& mesh) {
  const std::vector<std::string> names = file.names("Points");
  const std::string name = names.empty() ? "Points" : names.front();
  const std::vector<double> coordinates = file.reals("Points", name);
  const int line = file.line_of("Points", name);
  if (coordinates.empty() || coordinates.size() != 3 * file.n_points())
    file.fail("there are " + std::to_string(coordinates.size()) + " coordinates for " +
                  std::to_string(file.n_points()) + " points: give three for each",
              line);
  const Eigen::Map<const Eigen::Matrix3Xd> points(coordinates.data(), 3, static_cast<Index>(file.n_points()));
  if (!points.allFinite()) file.fail("a coordinate is not finite: correct it where the mesh is made", line);
  mesh.vertices = points.topRows<2>();
  const double size = mesh.vertices.cwiseAbs().maxCoeff();
  if ((points.row(2).array() - points(2, 0)).abs().maxCoeff() > 1e-9 * size)
    file.fail("the points are not in one plane z = const.: give a plane mesh", line);
}

void read_cells(const VtuArrays& file, PolygonMesh& mesh) {
  const std::vector<std::int64_t> corners = file.whole_numbers("Cells", "connectivity"),
                                  ends = file.whole_numbers("Cells", "offsets"),
                                  types = file.whole_numbers("Cells", "types");
  if (ends.size() != file.n_cells() || types.size() != file.n_cells())
    file.fail("there are " + std::to_string(ends.size()) + " offsets and " + std::to_string(types.size()) +
                  " types for " + std::to_string(file.n_cells()) + " cells: give one for each",
              file.line_of("Cells", "offsets"));
  std::int64_t first = 0;
  for (std::size_t c = 0; c < ends.size(); ++c) {
    const std::string cell = "cell " + std::to_string(c);
    if (types[c] != 5 && types[c] != 7 && types[c] != 9)
      file.fail(cell + " is of VTK's type " + std::to_string(types[c]) +
                    ": keep polygons (7), triangles (5) and quadrilaterals (9) alone",
                file.line_of("Cells", "types"));
    if (ends[c] < first + 3 || ends[c] > static_cast<std::int64_t>(corners.size()))
      file.fail(cell + " ends at " + std::to_string(ends[c]) + " in the connectivity of " +
                    std::to_string(corners.size()) + ", where at least three vertices from " +
                    std::to_string(first) + " on belong to it: correct the offsets",
                file.line_of("Cells", "offsets"));
    for (; first < ends[c]; ++first) {
      const std::int64_t v = corners[static_cast<std::size_t>(first)];
      if (v < 0 || v >= mesh.vertices.cols())
        file.fail(cell + " has a vertex " + std::to_string(v) + ", but there are " +
                      std::to_string(mesh.vertices.cols()) + ", numbered from 0 on: correct the number",
                  file.line_of("Cells", "connectivity"));
      mesh.indices.push_back(static_cast<int>(v));
    }
    mesh.offsets.push_back(static_cast<int>(first));
    if (signed_area(mesh.outline(static_cast<int>(c))) < 0)
      std::reverse(mesh.indices.begin() + mesh.offsets[c], mesh.indices.end());
  }
}

/// The name after "cells:" or "edges:", if the array is a group.
std::string group_name(const std::string& array, const std::string& prefix) {
  return array.starts_with(prefix) ? array.substr(prefix.size()) : "";
}

void read_cell_groups(const VtuArrays& file, NamedMesh& named) {
  for (const std::string& array : file.names("CellData")) {
    const std::string name = group_name(array, "cells:");
    if (name.empty()) continue;
    const std::vector<std::int64_t> members = file.whole_numbers("CellData", array);
    const int line = file.line_of("CellData", array);
    if (members.size() != file.n_cells())
      file.fail("\"" + array + "\" has " + std::to_string(members.size()) + " numbers for " +
                    std::to_string(file.n_cells()) + " cells: give one for each",
                line);
    for (std::size_t c = 0; c < members.size(); ++c)
      if (members[c] != 0) named.cell_groups[name].push_back(static_cast<int>(c));
    if (!named.cell_groups.contains(name))
      file.fail("the group \"" + name + "\" has no cells: give it some, or take it out", line);
  }
}

void read_edge_groups(const VtuArrays& file, NamedMesh& named) {
  std::set<std::array<int, 2>> edges;
  for (int c = 0; c < named.mesh.n_cells(); ++c) {
    const std::span<const int> corners = named.mesh.cell(c);
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.insert({corners[k], corners[(k + 1) % corners.size()]});
  }
  for (const std::string& array : file.names("FieldData")) {
    const std::string name = group_name(array, "edges:");
    if (name.empty()) continue;
    const std::vector<std::int64_t> ends = file.whole_numbers("FieldData", array);
    const int line = file.line_of("FieldData", array);
    if (ends.empty() || ends.size() % 2 != 0)
      file.fail("the group \"" + name + "\" has " + std::to_string(ends.size()) +
                    " vertices: give two an edge, or take it out",
                line);
    for (std::size_t k = 0; k < ends.size(); k += 2) {
      std::array edge{static_cast<int>(ends[k]), static_cast<int>(ends[k + 1])};
      if (!edges.contains(edge)) std::swap(edge[0], edge[1]);
      if (!edges.contains(edge))
        file.fail("the group \"" + name + "\" has an edge from vertex " + std::to_string(ends[k]) +
                      " to vertex " + std::to_string(ends[k + 1]) + " that no cell has: correct it",
                  line);
      named.edge_groups[name].push_back(edge);
    }
  }
}

}  // namespace

NamedMesh read_vtu_mesh(const std::filesystem::path& path) {
  const VtuArrays file(path);
  NamedMesh named;
  read_vertices(file, named.mesh);
  read_cells(file, named.mesh);
  read_cell_groups(file, named);
  read_edge_groups(file, named);
  return named;
}

}  // namespace polyfem
