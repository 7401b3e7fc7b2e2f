#include <ddacontact/output/labels.hpp>

#include <numeric>

namespace ddacontact {

OutlineLabels label_outline(const PointsRef& outline, const std::vector<int>& corners, bool turned) {
  const int n_outline = static_cast<int>(outline.cols()), n = static_cast<int>(corners.size());
  OutlineLabels labels;
  labels.turned = turned;
  labels.n_vertices = n;
  labels.vertex.assign(n_outline, 0);
  labels.edge.assign(n_outline, 0);
  labels.along.assign(n_outline, 0);
  int number = n;
  for (int edge = 0; edge < n; ++edge) {  // of the scene
    const int k = turned ? (2 * n - 2 - edge) % n : edge;
    const int from = corners[k], to = corners[(k + 1) % n];
    const int n_nodes = (to - from + n_outline) % n_outline - 1;
    const double length = (outline.col(to) - outline.col(from)).norm();
    labels.vertex[from] = turned ? n - 1 - k : k;
    for (int i = 0; i <= n_nodes; ++i) labels.edge[(from + i) % n_outline] = edge;
    for (int i = 1; i <= n_nodes; ++i) {
      const int node = (from + (turned ? n_nodes + 1 - i : i)) % n_outline;
      labels.vertex[node] = number++;
      labels.along[node] = (outline.col(node) - outline.col(turned ? to : from)).norm() / length;
    }
  }
  return labels;
}

OutlineLabels label_outline(const PointsRef& outline, bool turned) {
  std::vector<int> corners(outline.cols());
  std::iota(corners.begin(), corners.end(), 0);
  return label_outline(outline, corners, turned);
}

}  // namespace ddacontact
