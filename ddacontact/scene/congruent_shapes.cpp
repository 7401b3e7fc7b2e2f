#include <ddacontact/scene/congruent_shapes.hpp>

#include <ddacontact/core/bytes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/corotation.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cstdint>

namespace ddacontact {

namespace {

enum class Model : char { polygon, affine, mesh };

ByteWriter key_of(Model model, int material) {
  ByteWriter key;
  key(model);
  key(material);
  return key;
}

/// Of what lives as long as the program.
void add_address(const void* thing, ByteWriter& key) {
  key(reinterpret_cast<std::uintptr_t>(thing));
}

}  // namespace

CongruentShapes::Shape CongruentShapes::shared(const std::string& key,
                                               const std::function<CorotationalShape()>& make) {
  if (!share_) return std::make_shared<CorotationalShape>(make());
  Shape& shape = shapes_[key];
  if (!shape) shape = std::make_shared<CorotationalShape>(make());
  return shape;
}

CongruentShapes::Shape CongruentShapes::polygon(int material, const BlockMaterial& properties,
                                                const PointsRef& outline, const polyfem::Basis& basis,
                                                const Integration& integration) {
  ByteWriter key = key_of(Model::polygon, material);
  key(Points(outline.colwise() - polyfem::area_moments(outline).centroid));
  add_address(&basis, key);
  add_address(integration.triangle_rule, key);
  key(integration.correction);
  return shared(key.bytes, [&] { return polygon_shape(properties, outline, basis, integration); });
}

CongruentShapes::Shape CongruentShapes::affine(int material, const BlockMaterial& properties,
                                               const PointsRef& outline,
                                               const std::optional<ControlVertices>& control) {
  const polyfem::AreaMoments moments = polyfem::area_moments(outline);
  ByteWriter key = key_of(Model::affine, material);
  key(moments.area);
  key(moments.second);
  key(Points(outline.colwise() - moments.centroid));
  add_address(&polyfem::suitable_basis(outline), key);
  for (int k = 0; control && k < 3; ++k) {
    key(control->x[k]);
    key(control->y[k]);
  }
  return shared(key.bytes, [&] { return affine_shape(properties, outline, control); });
}

CongruentShapes::Shape CongruentShapes::mesh(int material, const BlockMaterial& properties,
                                             const BlockMesh& mesh, polyfem::GradientCorrection correction) {
  const Points outline = mesh.points.leftCols(mesh.n_outline);
  ByteWriter key = key_of(Model::mesh, material);
  key(Points(mesh.points.colwise() - polyfem::area_moments(outline).centroid));
  key(polyfem::mean_gradient_weights(outline));
  key.list(mesh.cells, [&](const std::vector<int>& cell) { key.list(cell, key); });
  key.list(mesh.on_straight_edges, [&](const BlockMesh::EdgePoint& on) {
    key(on.point);
    key(on.start);
    key(on.end);
    key(on.along);
  });
  return shared(key.bytes, [&] { return mesh_shape(properties, mesh, correction); });
}

}  // namespace ddacontact
