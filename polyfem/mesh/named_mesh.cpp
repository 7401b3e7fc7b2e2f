#include <polyfem/mesh/named_mesh.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>

namespace polyfem {
namespace {

template <class Group>
const Group& find(const std::map<std::string, Group>& groups, const std::string& name, const char* of) {
  if (const auto found = groups.find(name); found != groups.end()) return found->second;
  std::string names;
  for (const auto& [other, group] : groups) names += (names.empty() ? "\"" : ", \"") + other + "\"";
  throw Error(
      "the mesh has no group of " + std::string(of) + " \"" + name + "\": " +
      (names.empty() ? "it has none at all; name groups where the mesh is made" : "there are " + names));
}

}  // namespace

const std::vector<int>& NamedMesh::cells(const std::string& group) const {
  return find(cell_groups, group, "cells");
}

const std::vector<std::array<int, 2>>& NamedMesh::edges(const std::string& group) const {
  return find(edge_groups, group, "edges");
}

std::vector<int> NamedMesh::vertices(const std::string& edge_group) const {
  std::vector<int> vertices;
  for (const auto& edge : edges(edge_group)) vertices.insert(vertices.end(), edge.begin(), edge.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace polyfem
