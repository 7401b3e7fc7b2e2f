/// \file A mesh of polygons with fields on it as a .vtu file.
#pragma once

#include <polyfem/io/vtu_file.hpp>
#include <polyfem/mesh/named_mesh.hpp>

#include <filesystem>
#include <string_view>

namespace polyfem {

/// A mesh and fields on its vertices and cells, to be written for ParaView and its like.
///
///     MeshFile file(mesh);
///     file.add_vertex_field("displacement", problem.solution());
///     file.write("cantilever.vtu");
class MeshFile {
 public:
  explicit MeshFile(const PolygonMesh& mesh);
  /// With its groups, for `read_vtu_mesh`: as cell fields "cells:NAME" of 0 and 1, and as lists "edges:NAME"
  /// of two vertices an edge. Throws Error for names that are empty or not plain in XML.
  explicit MeshFile(const NamedMesh& named);

  /// Values in the order of vertices: as many of each as there are times more values than vertices, column by
  /// column, so that a VectorXd of interleaved unknowns, Points and Tensors all fit. Two of each are a vector
  /// and get a third component, zero. The name needs no quoting in XML. Throws Error when the number of
  /// values is no multiple of the number of vertices.
  void add_vertex_field(std::string_view name, const Eigen::Ref<const MatrixXd>& values);
  /// The same for cells.
  void add_cell_field(std::string_view name, const Eigen::Ref<const MatrixXd>& values);

  /// Throws FileError.
  void write(const std::filesystem::path& path) const { file_.write(path); }

 private:
  void add(VtuSection section, std::string_view name, const Eigen::Ref<const MatrixXd>& values,
           Index n_points);

  VtuFile file_;
  Index n_vertices_, n_cells_;
};

}  // namespace polyfem
