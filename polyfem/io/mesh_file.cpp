#include <polyfem/io/mesh_file.hpp>

#include <polyfem/core/error.hpp>

namespace polyfem {
namespace {

std::span<const double> span_of(const MatrixXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// Vectors of the plane with a third component, zero.
MatrixXd in_space(const Eigen::Ref<const Points>& vectors) {
  MatrixXd result = MatrixXd::Zero(3, vectors.cols());
  result.topRows(2) = vectors;
  return result;
}

/// "cells:NAME", for a name that XML takes as it is.
std::string array_name(const std::string& kind, const std::string& name) {
  if (name.empty() || name.find_first_of("<>&\"") != std::string::npos)
    throw Error("the group \"" + name + "\" cannot be written: give it a name without <, >, & and quotes");
  return kind + ":" + name;
}

}  // namespace

MeshFile::MeshFile(const PolygonMesh& mesh) : n_vertices_(mesh.vertices.cols()), n_cells_(mesh.n_cells()) {
  file_.set_points(span_of(in_space(mesh.vertices)));
  const std::vector<std::int64_t> connectivity(mesh.indices.begin(), mesh.indices.end());
  const std::vector<std::int64_t> ends(mesh.offsets.begin() + 1, mesh.offsets.end());
  file_.set_cells(connectivity, ends, std::vector(ends.size(), VtkCell::polygon));
}

MeshFile::MeshFile(const NamedMesh& named) : MeshFile(named.mesh) {
  for (const auto& [name, cells] : named.cell_groups) {
    std::vector<std::uint8_t> members(static_cast<std::size_t>(n_cells_), 0);
    for (const int c : cells) members.at(static_cast<std::size_t>(c)) = 1;
    file_.add(VtuSection::cell_data, array_name("cells", name), members);
  }
  for (const auto& [name, edges] : named.edge_groups) {
    std::vector<std::int32_t> ends;
    for (const auto& edge : edges) ends.insert(ends.end(), edge.begin(), edge.end());
    file_.add(VtuSection::field_data, array_name("edges", name), ends, 2);
  }
}

void MeshFile::add(VtuSection section, std::string_view name, const Eigen::Ref<const MatrixXd>& values,
                   Index n_points) {
  if (n_points == 0 ? values.size() != 0 : values.size() % n_points != 0 || values.size() == 0)
    throw Error("the field \"" + std::string(name) + "\" has " + std::to_string(values.size()) +
                " values for " + std::to_string(n_points) +
                (section == VtuSection::point_data ? " vertices" : " cells") +
                ": it needs the same number for each");
  const Index n_components = n_points == 0 ? 1 : values.size() / n_points;
  const MatrixXd columns = values.reshaped(n_components, n_points);
  if (n_components == 2)
    file_.add(section, name, span_of(in_space(columns)), 3);
  else
    file_.add(section, name, span_of(columns), static_cast<int>(n_components));
}

void MeshFile::add_vertex_field(std::string_view name, const Eigen::Ref<const MatrixXd>& values) {
  add(VtuSection::point_data, name, values, n_vertices_);
}

void MeshFile::add_cell_field(std::string_view name, const Eigen::Ref<const MatrixXd>& values) {
  add(VtuSection::cell_data, name, values, n_cells_);
}

}  // namespace polyfem
