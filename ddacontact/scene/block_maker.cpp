#include <ddacontact/scene/block_maker.hpp>

#include <ddacontact/block/corotational_block.hpp>
#include <ddacontact/classic/affine_block.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

std::vector<bool> fixed_along(const VertexHolds& holds, int axis) {
  std::vector<bool> prescribed;
  for (const auto& of_vertex : holds) prescribed.push_back(of_vertex[axis].has_value());
  return prescribed;
}

}  // namespace

BlockMaker::BlockMaker(const Scene& scene, const std::vector<PlacedBlock>& placed,
                       const std::vector<Holds>& holds, std::vector<std::string>& notes)
    : local_holds(scene.blocks.size()),
      scene_(scene),
      placed_(placed),
      holds_(holds),
      notes_(notes),
      shapes_(scene.analysis.skip.congruent) {}

std::unique_ptr<Block> BlockMaker::make(int b) {
  const BlockDescription& description = scene_.blocks[b];
  const Material& rock = scene_.materials[description.material];
  const BlockMaterial material{polyfem::elasticity_matrix(rock.young, rock.poisson, scene_.analysis.plane),
                               rock.density};
  const Points& outline = placed_[b].outline;
  if (description.model == BlockModel::affine) return make_affine_block(b, material);

  if (description.model == BlockModel::mesh) return make_mesh_block(b, material);

  const polyfem::Basis& basis = description.model == BlockModel::mean_value
                                    ? static_cast<const polyfem::Basis&>(polyfem::mean_value)
                                    : polyfem::wachspress;
  const Integration integration = choose_integration(outline, scene_.analysis.gradient_correction, basis);
  const std::string name = "block \"" + scene_.block_name(b) + "\": ";
  if (!integration.definite)
    notes_.push_back(name +
                     "its integration rule gives a rank-deficient stiffness or an indefinite mass matrix");
  else if (integration.triangle_rule != &polyfem::hammer_rule(3))
    notes_.push_back(
        name +
        "integration rule raised: with fewer points stiffness or mass is rank-deficient or indefinite");
  std::unique_ptr<Block> block;
  if (corotational())
    block = std::make_unique<CorotationalBlock>(
        material, outline, shapes_.polygon(description.material, material, outline, basis, integration));
  else
    block = std::make_unique<VertexBlock>(material, outline, integration, basis);
  for (int v = 0; v < outline.cols(); ++v)
    for (int axis = 0; axis < 2; ++axis)
      if (holds_[b].vertices[v][axis])
        local_holds[b].push_back({2 * v + axis, v, axis, *holds_[b].vertices[v][axis]});
  return block;
}

std::unique_ptr<Block> BlockMaker::make_mesh_block(int b, const BlockMaterial& material) {
  const BlockMesh& mesh = *placed_[b].mesh;
  const int n_free_points = static_cast<int>(mesh.points.cols() - mesh.on_straight_edges.size());
  const auto hold = [&](int point, int axis, const TimeFunction& motion) {
    local_holds[b].push_back({2 * point + axis, point, axis, motion});
  };
  const int n = static_cast<int>(mesh.vertex.size());
  for (int axis = 0; axis < 2; ++axis) {
    for (int point = 0; scene_.blocks[b].fixed && point < n_free_points; ++point) hold(point, axis, {});
    for (int v = 0; !scene_.blocks[b].fixed && v < n; ++v) {
      if (const auto& motion = holds_[b].vertices[v][axis]) hold(mesh.vertex[v], axis, *motion);
      const auto& motion = holds_[b].edges[v][axis];
      if (!motion) continue;
      const int end = v + 1 < n ? mesh.vertex[v + 1] : mesh.n_outline;
      for (int point = mesh.vertex[v] + 1; point < end; ++point) hold(point, axis, *motion);
    }
  }
  return std::make_unique<CorotationalBlock>(
      material, mesh.points,
      shapes_.mesh(scene_.blocks[b].material, material, mesh, scene_.analysis.gradient_correction));
}

std::unique_ptr<Block> BlockMaker::make_affine_block(int b, const BlockMaterial& material) {
  const Points& outline = placed_[b].outline;
  const std::vector<bool> fixed_x = fixed_along(holds_[b].vertices, 0),
                          fixed_y = fixed_along(holds_[b].vertices, 1);
  const auto n_x = std::count(fixed_x.begin(), fixed_x.end(), true),
             n_y = std::count(fixed_y.begin(), fixed_y.end(), true);
  if (n_x + n_y == 0) return affine_block(b, material, std::nullopt);

  const bool fully_prescribed = n_x >= 3 && n_y >= 3;
  if (scene_.analysis.preset == Preset::paper && !fully_prescribed) {
    for (int v = 0; v < outline.cols(); ++v)
      for (int axis = 0; axis < 2; ++axis)
        if (holds_[b].vertices[v][axis])
          springs.push_back({b, v, axis == 0, axis == 1, *holds_[b].vertices[v][axis]});
    return affine_block(b, material, std::nullopt);
  }
  const ControlVertices control = choose_control_vertices(outline, fixed_x, fixed_y);
  for (int axis = 0; axis < 2; ++axis) {
    const std::array<int, 3>& vertices = axis == 0 ? control.x : control.y;
    if ((axis == 0 ? n_x : n_y) > 3) check_followed(holds_[b].vertices, outline, vertices, axis, scene_, b);
    for (int k = 0; k < 3; ++k)
      if (const auto& motion = holds_[b].vertices[vertices[k]][axis])
        local_holds[b].push_back({2 * k + axis, vertices[k], axis, *motion});
  }
  return affine_block(b, material, control);
}

std::unique_ptr<Block> BlockMaker::affine_block(int b, const BlockMaterial& material,
                                                const std::optional<ControlVertices>& control) {
  const Points& outline = placed_[b].outline;
  if (!corotational()) return std::make_unique<AffineBlock>(material, outline, control);
  return std::make_unique<CorotationalBlock>(
      material, outline, shapes_.affine(scene_.blocks[b].material, material, outline, control));
}

}  // namespace ddacontact
