/// \file Reference shapes that congruent blocks share.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>

namespace ddacontact {

/// Keeps the shapes that it has handed out. Blocks are congruent here when all that their shapes follow from
/// is the same to the last bit: shared or not, matrices are the same.
class CongruentShapes {
 public:
  using Shape = std::shared_ptr<const CorotationalShape>;

  /// \param[in] share  false: every block gets its own
  explicit CongruentShapes(bool share) : share_(share) {}

  /// See polygon_shape, affine_shape and mesh_shape. `material` tells materials apart.
  Shape polygon(int material, const BlockMaterial& properties, const PointsRef& outline,
                const polyfem::Basis& basis, const Integration& integration);
  Shape affine(int material, const BlockMaterial& properties, const PointsRef& outline,
               const std::optional<ControlVertices>& control);
  Shape mesh(int material, const BlockMaterial& properties, const BlockMesh& mesh,
             polyfem::GradientCorrection correction);

 private:
  Shape shared(const std::string& key, const std::function<CorotationalShape()>& make);

  bool share_;
  std::unordered_map<std::string, Shape> shapes_;  ///< by the bits of all that they follow from
};

}  // namespace ddacontact
