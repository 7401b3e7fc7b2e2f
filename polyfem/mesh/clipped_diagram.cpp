#include <polyfem/mesh/clipped_diagram.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/geos_context.hpp>

namespace polyfem {

namespace {

using Prepared = std::unique_ptr<const GEOSPreparedGeometry, DestroyGeometry>;

GeosGeometry polygon(const GeosContext& geos, const PointsRef& outline) {
  Points closed(2, outline.cols() + 1);
  closed << outline, outline.col(0);
  GEOSGeometry* ring = geos.checked(GEOSGeom_createLinearRing_r(geos.handle(), coordinates(geos, closed)));
  return own(geos, GEOSGeom_createPolygon_r(geos.handle(), ring, nullptr, 0));
}

/// The sites and four more, so far away that they change nothing within the domain: GEOS needs several sites,
/// and its outermost cells are not reliable.
Points surrounded(const PointsRef& domain, const Points& sites) {
  const Vec2 low = domain.rowwise().minCoeff(), high = domain.rowwise().maxCoeff();
  const Vec2 centre = (low + high) / 2;
  const double distance = 4 * (high - low).norm();
  Points all(2, sites.cols() + 4);
  all << sites, centre + Vec2(distance, 0), centre + Vec2(0, distance), centre - Vec2(distance, 0),
      centre - Vec2(0, distance);
  return all;
}

GeosGeometry diagram(const GeosContext& geos, const Points& sites) {
  const GeosGeometry line = own(geos, GEOSGeom_createLineString_r(geos.handle(), coordinates(geos, sites)));
  return own(geos, GEOSVoronoiDiagram_r(geos.handle(), line.get(), nullptr, 0, 0));
}

/// Adds every polygon of a geometry; lines and points, where a cell touches the domain, have no area.
void add_rings(const GeosContext& geos, const GEOSGeometry* geometry, Rings& rings) {
  const int n_parts = GEOSGetNumGeometries_r(geos.handle(), geometry);
  for (int i = 0; i < n_parts; ++i) {
    const GEOSGeometry* part = geos.checked(GEOSGetGeometryN_r(geos.handle(), geometry, i));
    if (GEOSGeomTypeId_r(geos.handle(), part) != GEOS_POLYGON || GEOSisEmpty_r(geos.handle(), part)) continue;
    const GEOSGeometry* ring = geos.checked(GEOSGetExteriorRing_r(geos.handle(), part));
    const Points points = points_of(geos, ring);
    const Index n = points.cols() - 1;
    const bool clockwise = signed_area(points.leftCols(n)) < 0;
    for (Index k = 0; k < n; ++k) rings.points.push_back(points.col(clockwise ? n - 1 - k : k));
    rings.offsets.push_back(static_cast<int>(rings.points.size()));
  }
}

}  // namespace

Rings clipped_voronoi_diagram(const PointsRef& domain, const Points& sites) {
  const GeosContext geos("compute the Voronoi cells");
  const GeosGeometry outline = polygon(geos, domain);
  const Prepared prepared(geos.checked(GEOSPrepare_r(geos.handle(), outline.get())),
                          DestroyGeometry{geos.handle()});
  const GeosGeometry cells = diagram(geos, surrounded(domain, sites));
  const int n_cells = GEOSGetNumGeometries_r(geos.handle(), cells.get());
  Rings rings;
  for (int i = 0; i < n_cells; ++i) {
    const GEOSGeometry* cell = geos.checked(GEOSGetGeometryN_r(geos.handle(), cells.get(), i));
    if (GEOSPreparedContainsProperly_r(geos.handle(), prepared.get(), cell) == 1)
      add_rings(geos, cell, rings);
    else
      add_rings(geos, own(geos, GEOSIntersection_r(geos.handle(), cell, outline.get())).get(), rings);
  }
  return rings;
}

}  // namespace polyfem
