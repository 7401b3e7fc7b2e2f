#include <ddacontact/picture/fan_mesh.hpp>

namespace ddacontact {

bool FanMesh::is_corner(int node) const {
  return node >= first(rings_) && (node - first(rings_)) % rings_ == 0;
}

Points FanMesh::nodes(const PointsRef& outline, const Vec2& centroid) const {
  Points nodes(2, n_nodes());
  nodes.col(0) = centroid;
  for (int r = 1; r <= rings_; ++r)
    for (int sector = 0; sector < n_corners_; ++sector) {
      const Vec2 here = outline.col(sector), next = outline.col((sector + 1) % n_corners_);
      for (int j = 0; j < r; ++j) {
        const double outward = static_cast<double>(r) / rings_, along = static_cast<double>(j) / r;
        // Exactly on the outline and at its corners, where shape functions ask for it.
        const Vec2 rim = j == 0 ? here : Vec2(here + along * (next - here));
        nodes.col(node(r, sector * r + j)) = r == rings_ ? rim : Vec2(centroid + outward * (rim - centroid));
      }
    }
  return nodes;
}

}  // namespace ddacontact
