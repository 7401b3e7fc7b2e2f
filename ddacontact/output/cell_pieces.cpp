#include <ddacontact/output/cell_pieces.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>

#include <numeric>

namespace ddacontact {

namespace {

bool is_seen_from_centroid(const Points& corners) {
  const Vec2 centroid = polyfem::area_moments(corners).centroid;
  for (Index k = 0; k < corners.cols(); ++k) {
    const Vec2 from = corners.col(k) - centroid, to = corners.col((k + 1) % corners.cols()) - centroid;
    if (!(cross(from, to) > 0)) return false;
  }
  return true;
}

}  // namespace

std::vector<CellPiece> pieces_of(const PointsRef& corners) {
  std::vector<CellPiece> pieces(1, CellPiece(corners.cols()));
  std::iota(pieces[0].begin(), pieces[0].end(), 0);
  const Points local = corners.colwise() - Vec2(corners.col(0));
  if (is_seen_from_centroid(local) || polyfem::find_defect(local) || polyfem::signed_area(local) < 0)
    return pieces;
  pieces.clear();
  const polyfem::Triangles triangles = polyfem::triangulate(local);
  for (const auto triangle : triangles.colwise()) pieces.emplace_back(triangle.begin(), triangle.end());
  return pieces;
}

Vec2 centre_of(const PointsRef& outline) {
  const Vec2 centroid = polyfem::area_moments(outline).centroid;
  return centroid.allFinite() ? centroid : Vec2(outline.rowwise().mean());
}

}  // namespace ddacontact
