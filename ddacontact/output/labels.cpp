#include <ddacontact/output/labels.hpp>

#include <numeric>

namespace ddacontact {

std::vector<int> OutlineLabels::in_scene_order() const {
  std::vector<int> order(vertex.size());
  for (std::size_t v = 0; v < vertex.size(); ++v) order[vertex[v]] = static_cast<int>(v);
  return order;
}

OutlineLabels label_outline(int n_outline, const std::vector<int>& corners, bool turned) {
  const int n = static_cast<int>(corners.size());
  OutlineLabels labels;
  labels.turned = turned;
  labels.n_vertices = n;
  labels.vertex.assign(n_outline, 0);
  labels.edge.assign(n_outline, 0);
  int number = n;
  for (int edge = 0; edge < n; ++edge) {  // of the scene
    const int k = turned ? (2 * n - 2 - edge) % n : edge;
    const int from = corners[k], to = corners[(k + 1) % n];
    const int n_nodes = (to - from + n_outline) % n_outline - 1;
    labels.vertex[from] = turned ? n - 1 - k : k;
    for (int i = 0; i <= n_nodes; ++i) labels.edge[(from + i) % n_outline] = edge;
    for (int i = 1; i <= n_nodes; ++i)
      labels.vertex[(from + (turned ? n_nodes + 1 - i : i)) % n_outline] = number++;
  }
  return labels;
}

OutlineLabels label_outline(int n_vertices, bool turned) {
  std::vector<int> corners(n_vertices);
  std::iota(corners.begin(), corners.end(), 0);
  return label_outline(n_vertices, corners, turned);
}

}  // namespace ddacontact
