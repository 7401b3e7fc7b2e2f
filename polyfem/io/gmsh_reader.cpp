#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/io/gmsh_elements.hpp>
#include <polyfem/io/gmsh_reader.hpp>

#include <algorithm>
#include <set>

namespace polyfem {
namespace {

std::string name_of(const std::map<int, GmshGroup>& groups, int tag) {
  const auto found = groups.find(tag);
  return found == groups.end() ? std::to_string(tag) : found->second.name;
}

/// The vertices of nodes that cells have, in the order of nodes.
std::unordered_map<int, int> number_vertices(const GmshFile& file, PolygonMesh& mesh) {
  std::unordered_map<int, int> vertex_of;
  for (const GmshElement& cell : file.cells)
    for (const int node : cell.nodes) vertex_of[node] = -1;
  mesh.vertices.resize(2, static_cast<Index>(vertex_of.size()));
  int next = 0;
  for (const int tag : file.node_tags)
    if (const auto found = vertex_of.find(tag); found != vertex_of.end()) {
      mesh.vertices.col(next) = file.nodes.at(tag);
      found->second = next++;
    }
  return vertex_of;
}

void add_cells(const GmshFile& file, const std::unordered_map<int, int>& vertex_of, NamedMesh& named) {
  std::map<std::vector<int>, int> cell_of;  // by its corners in the file's order
  for (const GmshElement& element : file.cells) {
    std::vector<int> corners;
    for (const int node : element.nodes) corners.push_back(vertex_of.at(node));
    const auto [cell, is_new] = cell_of.try_emplace(corners, named.mesh.n_cells());
    if (is_new) {
      named.mesh.add_cell(corners);
      if (signed_area(named.mesh.outline(cell->second)) < 0)
        std::reverse(named.mesh.indices.end() - static_cast<std::ptrdiff_t>(corners.size()),
                     named.mesh.indices.end());
    }
    for (const int tag : element.physical_groups)
      named.cell_groups[name_of(file.cell_groups, tag)].push_back(cell->second);
  }
}

std::set<std::array<int, 2>> directed_edges(const PolygonMesh& mesh) {
  std::set<std::array<int, 2>> edges;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> corners = mesh.cell(c);
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.insert({corners[k], corners[(k + 1) % corners.size()]});
  }
  return edges;
}

void add_edges(const GmshFile& file, const std::unordered_map<int, int>& vertex_of, const LineReader& in,
               NamedMesh& named) {
  const std::set<std::array<int, 2>> edges = directed_edges(named.mesh);
  for (const GmshElement& line : file.lines) {
    if (line.physical_groups.empty()) continue;
    const auto first = vertex_of.find(line.nodes[0]), second = vertex_of.find(line.nodes[1]);
    std::array edge{-1, -1};
    if (first != vertex_of.end() && second != vertex_of.end()) {
      edge = {first->second, second->second};
      if (!edges.contains(edge)) std::swap(edge[0], edge[1]);
    }
    if (!edges.contains(edge))
      in.fail(
          "the line from node " + std::to_string(line.nodes[0]) + " to node " +
              std::to_string(line.nodes[1]) +
              " is in a group but is no edge of a cell: mesh the surface beside it, or take it out of the "
              "group",
          line.line);
    for (const int tag : line.physical_groups)
      named.edge_groups[name_of(file.line_groups, tag)].push_back(edge);
  }
}

template <class Members>
void require_members(const std::map<int, GmshGroup>& groups, const Members& members, const char* what,
                     const LineReader& in) {
  for (const auto& [tag, group] : groups)
    if (!members.contains(group.name))
      in.fail("the group \"" + group.name + "\" has no " + what +
                  ": give it some that are meshed, or take its name out",
              group.line);
}

}  // namespace

NamedMesh read_gmsh(const std::filesystem::path& path) {
  LineReader in(path);
  const GmshFile file = read_gmsh_file(in);
  if (file.cells.empty())
    in.fail(
        "the file has no triangles or quadrilaterals: mesh in two dimensions (gmsh -2), and save all or "
        "put the surfaces into a physical group");
  NamedMesh named;
  const std::unordered_map<int, int> vertex_of = number_vertices(file, named.mesh);
  add_cells(file, vertex_of, named);
  add_edges(file, vertex_of, in, named);
  require_members(file.cell_groups, named.cell_groups, "cells", in);
  require_members(file.line_groups, named.edge_groups, "edges", in);
  return named;
}

}  // namespace polyfem
