#include <ddacontact/scene/builder.hpp>

#include <ddacontact/block/corotational_block.hpp>
#include <ddacontact/classic/affine_block.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/scene/bolt_path.hpp>
#include <ddacontact/scene/congruent_shapes.hpp>
#include <ddacontact/scene/model_choice.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace ddacontact {

namespace {

const char* model_name(BlockModel model) {
  switch (model) {
    case BlockModel::mean_value:
      return "mean_value";
    case BlockModel::affine:
      return "affine";
    case BlockModel::mesh:
      return "mesh";
    default:
      return "wachspress";
  }
}

/// Where each vertex of a block is held, by axis; no entry: free.
using VertexHolds = std::vector<std::array<std::optional<TimeFunction>, 2>>;

/// A block's outline in our terms: counter-clockwise, relative to the origin.
struct Placed {
  Points outline;
  bool turned;
  std::optional<BlockMesh> mesh;

  /// Of the scene's vertex, counted counter-clockwise.
  int ours(int scene_vertex) const {
    return turned ? static_cast<int>(outline.cols()) - 1 - scene_vertex : scene_vertex;
  }
  OutlineLabels labels() const {
    return mesh ? label_outline(mesh->n_outline, mesh->vertex, turned)
                : label_outline(static_cast<int>(outline.cols()), turned);
  }
  /// The number among the points of the block, of a vertex counted counter-clockwise.
  int point(int vertex) const { return mesh ? mesh->vertex[vertex] : vertex; }
};

Vec2 low_corner(const Scene& scene) {
  Vec2 low = scene.blocks.front().vertices.col(0);
  for (const BlockDescription& block : scene.blocks) low = low.cwiseMin(block.vertices.rowwise().minCoeff());
  return low;
}

/// Points of a block's outline that are no further from another block than its cells are to be there, half of
/// that apart.
std::vector<Vec2> contact_zone(const Scene& scene, int block) {
  const double near = scene.blocks[block].mesh.at_contact;
  const Points& outline = scene.blocks[block].vertices;
  const Box own = bounding_box(outline, near);
  std::vector<const Points*> others;
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b)
    if (b != block && touch(own, bounding_box(scene.blocks[b].vertices)))
      others.push_back(&scene.blocks[b].vertices);
  std::vector<Vec2> zone;
  for (Index k = 0; k < outline.cols(); ++k) {
    const Vec2 start = outline.col(k), edge = outline.col((k + 1) % outline.cols()) - start;
    const int n = static_cast<int>(std::ceil(2 * edge.norm() / near));
    for (int i = 0; i < n; ++i) {
      const Vec2 x = start + static_cast<double>(i) / n * edge;
      for (const Points* other : others)
        if (scene_format::distance_to_outline(x, *other) <= near) {
          zone.push_back(x);
          break;
        }
    }
  }
  return zone;
}

Placed location(const Scene& scene, int index, const Vec2& origin) {
  const BlockDescription& block = scene.blocks[index];
  Placed placed{block.vertices.colwise() - origin, polyfem::signed_area(block.vertices) < 0, {}};
  if (placed.turned) placed.outline = placed.outline.rowwise().reverse().eval();
  if (block.model != BlockModel::mesh) return placed;
  std::vector<Vec2> contact;
  if (block.mesh.at_contact > 0) contact = contact_zone(scene, index);
  for (Vec2& x : contact) x -= origin;
  placed.mesh = divide(placed.outline, block.mesh, contact);
  return placed;
}

/// How a block is held: its vertices, and the edges (by their first vertex) both ends of which are held at
/// once, by one support or by the block itself. What two supports hold are points: the edge between them is
/// free.
struct Holds {
  VertexHolds vertices, edges;

  explicit Holds(Index n) : vertices(n), edges(n) {}

  void hold(const std::vector<int>& prescribed, int axis, const TimeFunction& motion) {
    std::vector<bool> is_prescribed(vertices.size());
    for (int v : prescribed) is_prescribed[v] = true;
    for (std::size_t v = 0; v < is_prescribed.size(); ++v) {
      if (!is_prescribed[v]) continue;
      vertices[v][axis] = motion;
      if (is_prescribed[(v + 1) % is_prescribed.size()]) edges[v][axis] = motion;
    }
  }
};

std::vector<Holds> collect_holds(const Scene& scene, const std::vector<Placed>& placed) {
  std::vector<Holds> holds;
  const auto ours = [&](int block, std::vector<int> vertices) {
    for (int& v : vertices) v = placed[block].ours(v);
    return vertices;
  };
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b) {
    const BlockDescription& block = scene.blocks[b];
    Holds& of_block = holds.emplace_back(block.vertices.cols());
    std::vector<int> fixed = ours(b, block.fixed_vertices);
    if (block.fixed) {
      fixed.resize(block.vertices.cols());
      std::iota(fixed.begin(), fixed.end(), 0);
    }
    for (int axis = 0; axis < 2; ++axis) of_block.hold(fixed, axis, {});
  }
  for (const Support& support : scene.supports) {
    const std::vector<int> prescribed = ours(support.block, support.vertices);
    if (support.fix_x) holds[support.block].hold(prescribed, 0, support.displacement);
    if (support.fix_y) holds[support.block].hold(prescribed, 1, support.displacement);
  }
  return holds;
}

std::vector<bool> fixed_along(const VertexHolds& holds, int axis) {
  std::vector<bool> prescribed;
  for (const auto& of_vertex : holds) prescribed.push_back(of_vertex[axis].has_value());
  return prescribed;
}

/// A block's numbering is known only when all blocks are: what to hold is said by local numbers first.
struct LocalHold {
  int unknown, vertex, axis;
  TimeFunction motion;
};

/// An affine field is told by three vertices; what is asked of a fourth must agree with it all the time.
void check_followed(const VertexHolds& holds, const PointsRef& outline, const std::array<int, 3>& control,
                    int axis, const Scene& scene, int block) {
  const Vec2 origin = outline.col(control[0]);
  const Vec2 p = outline.col(control[1]) - origin, q = outline.col(control[2]) - origin;
  for (std::size_t v = 0; v < holds.size(); ++v) {
    if (!holds[v][axis] || std::find(control.begin(), control.end(), v) != control.end()) continue;
    const Vec2 r = outline.col(static_cast<Index>(v)) - origin;
    const double a = cross(r, q) / cross(p, q), b = cross(p, r) / cross(p, q);
    const int n_steps = scene.n_steps();
    for (int step = 0; step <= n_steps; ++step) {
      const double time = step * scene.end_time() / n_steps;
      const auto at = [&](int vertex) { return (*holds[vertex][axis]).at(time, scene.end_time())[axis]; };
      const double told = (1 - a - b) * at(control[0]) + a * at(control[1]) + b * at(control[2]);
      const double asked = at(static_cast<int>(v));
      if (std::abs(told - asked) > 1e-9 * (std::abs(told) + std::abs(asked)))
        throw Error(
            "the supports of block \"" + scene.block_name(block) +
            "\" ask for displacements that its affine model cannot follow (hold at most three vertices, or "
            "use model = \"wachspress\")");
    }
  }
}

class Builder {
 public:
  /// \param[in] reasons  why blocks have the models that the scene states; empty: the user chose it
  Builder(const Scene& scene, const std::vector<std::string>& reasons)
      : scene_(scene), reasons_(reasons), origin_(low_corner(scene)), shapes_(scene.analysis.skip.congruent) {
    for (std::size_t b = 0; b < scene.blocks.size(); ++b)
      placed_.push_back(location(scene, static_cast<int>(b), origin_));
    holds_ = collect_holds(scene, placed_);
  }

  /// What of the stress in each block bends it and is missing, see missing_bending; all < 0: not known.
  std::vector<double> missing() {
    BlockSystem system = make_system();
    BlockState initial = system.initial_state();
    set_initial(system, initial);
    for (const Bolt& bolt : system.bolts) install(bolt, system, initial);
    ContactBuilder contacts(system, contact_properties());
    const FirstLoading loading = load_once(system, initial, contacts);
    if (!loading.settled) return std::vector<double>(scene_.blocks.size(), -1);
    return missing_bending(system, initial, loading);
  }

  BuiltScene build() {
    BlockSystem system = make_system();
    note_idle_velocities(system);
    note_domain();
    built_.labels.origin = origin_;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) {
      built_.labels.block_names.push_back(scene_.block_name(static_cast<int>(b)));
      system.names[b] = scene_.block_name(static_cast<int>(b));
      built_.labels.block_models.push_back(model_name(scene_.blocks[b].model));
      built_.labels.block_materials.push_back(scene_.blocks[b].material);
      built_.labels.block_reasons.push_back(reasons_[b]);
      built_.labels.outlines.push_back(outline_labels(placed_[b]));
    }
    for (const Material& material : scene_.materials) built_.labels.material_names.push_back(material.name);
    for (std::size_t j = 0; j < scene_.joints.size(); ++j)
      built_.labels.joint_names.push_back(scene_.joints[j].name.empty() ? std::to_string(j)
                                                                        : scene_.joints[j].name);
    for (const Monitor& monitor : scene_.monitors)
      built_.monitor_targets.push_back(make_monitor_target(monitor, system));

    BlockState initial = system.initial_state();
    set_initial(system, initial);
    std::vector<Stage> parts = stages(system);
    built_.stepper = std::make_unique<Stepper>(std::move(system), std::move(initial), contact_properties(),
                                               std::move(parts));
    return std::move(built_);
  }

 private:
  BlockSystem make_system() {
    std::vector<std::unique_ptr<Block>> blocks;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) blocks.push_back(make_block(static_cast<int>(b)));
    BlockSystem system(std::move(blocks));
    system.round_corners(scene_.contact.corner_rounding);
    system.compute_fixed(!scene_.analysis.skip.fixed_blocks);
    hold(system);
    system.gravity = scene_.analysis.gravity;
    system.end_time = scene_.end_time();
    add_loads(system);
    add_quiet_faces(system);
    for (const Quake& quake : scene_.quakes) system.ground.push_back(quake.acceleration);
    system.set_bolts(bolts(system));
    return system;
  }

  /// The same for all outlines of so many vertices in the same sense.
  std::shared_ptr<const OutlineLabels> outline_labels(const Placed& placed) {
    if (placed.mesh) return std::make_shared<const OutlineLabels>(placed.labels());
    auto& labels = outline_labels_[{placed.outline.cols(), placed.turned}];
    if (!labels) labels = std::make_shared<const OutlineLabels>(placed.labels());
    return labels;
  }

  std::unique_ptr<Block> make_block(int b) {
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
      built_.notes.push_back(
          name + "its integration rule gives a rank-deficient stiffness or an indefinite mass matrix");
    else if (integration.triangle_rule != &polyfem::hammer_rule(3))
      built_.notes.push_back(
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
          local_holds_[b].push_back({2 * v + axis, v, axis, *holds_[b].vertices[v][axis]});
    return block;
  }

  /// All of a fixed block is held.
  std::unique_ptr<Block> make_mesh_block(int b, const BlockMaterial& material) {
    const BlockMesh& mesh = *placed_[b].mesh;
    const int n_free_points = static_cast<int>(mesh.points.cols() - mesh.on_straight_edges.size());
    const auto hold = [&](int point, int axis, const TimeFunction& motion) {
      local_holds_[b].push_back({2 * point + axis, point, axis, motion});
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

  std::unique_ptr<Block> make_affine_block(int b, const BlockMaterial& material) {
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
            springs_.push_back({b, v, axis == 0, axis == 1, *holds_[b].vertices[v][axis]});
      return affine_block(b, material, std::nullopt);
    }
    const ControlVertices control = choose_control_vertices(outline, fixed_x, fixed_y);
    for (int axis = 0; axis < 2; ++axis) {
      const std::array<int, 3>& vertices = axis == 0 ? control.x : control.y;
      if ((axis == 0 ? n_x : n_y) > 3) check_followed(holds_[b].vertices, outline, vertices, axis, scene_, b);
      for (int k = 0; k < 3; ++k)
        if (const auto& motion = holds_[b].vertices[vertices[k]][axis])
          local_holds_[b].push_back({2 * k + axis, vertices[k], axis, *motion});
    }
    return affine_block(b, material, control);
  }

  bool corotational() const { return scene_.analysis.kinematics == Kinematics::corotational; }

  std::unique_ptr<Block> affine_block(int b, const BlockMaterial& material,
                                      const std::optional<ControlVertices>& control) {
    const Points& outline = placed_[b].outline;
    if (!corotational()) return std::make_unique<AffineBlock>(material, outline, control);
    return std::make_unique<CorotationalBlock>(
        material, outline, shapes_.affine(scene_.blocks[b].material, material, outline, control));
  }

  void hold(BlockSystem& system) const {
    std::vector<PrescribedDof> prescribed;
    for (int b = 0; b < system.n_blocks(); ++b) {
      const Block& block = system.block(b);
      for (const LocalHold& hold : local_holds_[b])
        prescribed.push_back({block.unknowns().first + hold.unknown, block.vertices().first + hold.vertex,
                              hold.axis, hold.motion});
    }
    system.set_prescribed_dofs(std::move(prescribed));
    system.fixed_vertices = springs_;
    for (int b = 0; b < system.n_blocks(); ++b)
      for (std::size_t v = 0; v < holds_[b].vertices.size(); ++v)
        if (holds_[b].vertices[v][0] || holds_[b].vertices[v][1])
          system.supported_vertices.push_back(system.block(b).points().first +
                                              placed_[b].point(static_cast<int>(v)));
  }

  void note_idle_velocities(const BlockSystem& system) {
    for (int b = 0; b < system.n_blocks(); ++b) {
      const BlockDescription& block = scene_.blocks[b];
      if (!system.is_movable(b) && (!block.velocity.isZero(0) || block.angular_velocity != 0))
        built_.notes.push_back("block \"" + scene_.block_name(b) +
                               "\" is held: its initial velocity has no effect");
    }
  }

  void note_domain() {
    if (!scene_.domain) return;
    const DomainCounts& cut = *scene_.domain;
    const auto n = [](int count) { return std::to_string(count); };
    built_.notes.push_back(
        "the domain is cut into " + n(cut.blocks) + " blocks: slivers merged " + n(cut.slivers_merged) +
        ", left " + n(cut.slivers_left) + "; dead ends of joints removed " + n(cut.dangling_removed) +
        "; connecting joints added " + n(cut.connecting_joints) + "; T-vertices " + n(cut.t_vertices));
  }

  /// visit(edge) for all edges of the block, as it numbers them, that an edge of the scene is divided into.
  template <class Visit>
  static void for_parts(const Block& block, const Placed& on, int scene_edge, Visit&& visit) {
    const int n = static_cast<int>(on.outline.cols());
    const int edge = on.turned ? (2 * n - 2 - scene_edge) % n : scene_edge;
    const int end = edge + 1 < n ? on.point(edge + 1) : block.n_vertices();
    for (int part = on.point(edge); part < end; ++part) visit(part);
  }

  void add_quiet_faces(BlockSystem& system) const {
    for (const QuietBoundary& boundary : scene_.quiet_boundaries)
      for (const auto& [block, edge] : boundary.faces)
        for_parts(system.block(block), placed_[block], edge, [&, b = block](int part) {
          system.quiet_faces.push_back({b, part, scene_.blocks[b].stress, boundary.incoming});
        });
  }

  void add_loads(BlockSystem& system) const {
    std::set<int> later;
    for (const StageDescription& stage : scene_.stages) later.insert(stage.loads.begin(), stage.loads.end());
    for (int l = 0; l < static_cast<int>(scene_.loads.size()); ++l)
      if (!later.contains(l)) add_load(l, system, system);
  }

  /// \param[in,out] to  has `point_loads`, `pressure_loads` and `body_loads`: the system, or a stage
  void add_load(int l, const BlockSystem& system, auto& to) const {
    const Load& load = scene_.loads[l];
    const Placed& on = placed_[load.block];
    const Block& block = system.block(load.block);
    switch (load.kind) {
      case Load::Kind::point:
        to.point_loads.push_back({{load.block, block.point_weights(load.at - origin_)}, load.force});
        break;
      case Load::Kind::pressure:
        for_parts(block, on, load.edge, [&](int part) {
          to.pressure_loads.push_back({load.block, part, load.force});
        });
        break;
      case Load::Kind::body:
        to.body_loads.push_back({load.block, load.force});
        break;
    }
  }

  std::vector<Bolt> bolts(const BlockSystem& system) const {
    std::vector<Bolt> all;
    for (const RockBolt& bolt : scene_.bolts) {
      Bolt& made = all.emplace_back();
      made.name = bolt.name;
      for (const BoltNode& node : bolt_nodes(bolt, scene_.blocks)) {
        made.nodes.push_back({node.block, system.block(node.block).point_weights(node.at - origin_)});
        if (node.length > 0) made.bonded.push_back(node.length);
      }
      made.stiffness = bolt.young * bolt.area / bolt.spacing;
      made.yield = bolt.yield_force.value_or(Bolt::infinity) / bolt.spacing;
      made.rupture_strain = bolt.rupture_strain.value_or(Bolt::infinity);
      made.pretension = bolt.pretension / bolt.spacing;
      made.bond_stiffness = bolt.bond_stiffness / bolt.spacing;
      made.bond_strength = bolt.bond_strength.value_or(Bolt::infinity) / bolt.spacing;
    }
    return all;
  }

  MonitorTarget make_monitor_target(const Monitor& monitor, const BlockSystem& system) const {
    const Placed& on = placed_[monitor.block];
    const Block& block = system.block(monitor.block);
    switch (monitor.kind) {
      case Monitor::Kind::point:
        return {monitor.name, MaterialPoint{monitor.block, block.point_weights(monitor.at - origin_)}};
      case Monitor::Kind::vertex: {
        VectorXd weights = VectorXd::Zero(block.n_points());
        weights[on.point(on.ours(monitor.vertex))] = 1;
        return {monitor.name, MaterialPoint{monitor.block, weights}};
      }
      case Monitor::Kind::centroid:
        break;
    }
    return {monitor.name, Centroid{monitor.block}};
  }

  void set_initial(BlockSystem& system, BlockState& initial) const {
    system.prepare(initial, true);
    bool stressed = false;
    for (int b = 0; b < system.n_blocks(); ++b)
      stressed = stressed || system.block(b).changes_stress() || !scene_.blocks[b].stress.isZero(0);
    if (!stressed) initial.stress.resize(3, 0);
    for (int b = 0; b < system.n_blocks(); ++b) {
      const BlockDescription& description = scene_.blocks[b];
      const Block& block = system.block(b);
      if (stressed)
        initial.stress.middleCols(block.stress_points().first, block.stress_points().count).colwise() =
            description.stress;
      if (first_stage().analysis.mode == Mode::statics) continue;
      const Vec3 rigid(description.velocity.x(), description.velocity.y(), description.angular_velocity);
      initial.velocity.segment(block.unknowns().first, block.unknowns().count) = block.rigid_modes() * rigid;
    }
    for (const PrescribedDof& prescribed : system.prescribed_dofs()) initial.velocity[prescribed.unknown] = 0;
  }

  static std::optional<double> tangent_of(const std::optional<double>& degrees) {
    if (!degrees) return std::nullopt;
    return std::tan(*degrees * std::numbers::pi / 180);
  }

  static JointTable joint_table(const std::vector<Joint>& joints) {
    std::vector<JointTable::Entry> entries;
    for (const Joint& joint : joints)
      entries.push_back({{std::tan(joint.friction_angle * std::numbers::pi / 180),
                          joint.cohesion,
                          joint.tensile_strength,
                          {},
                          joint.restitution,
                          joint.dashpot,
                          joint.glued,
                          joint.normal_stiffness.value_or(0),
                          joint.shear_stiffness.value_or(0),
                          tangent_of(joint.residual_friction_angle),
                          tangent_of(joint.dilation_angle).value_or(0),
                          joint.dilation_slip.value_or(0),
                          joint.ductile,
                          joint.compressive_strength.value_or(0)},
                         joint.between});
    return JointTable(std::move(entries));
  }

  /// Of the edges of the outlines; nothing where no block has any.
  std::vector<std::vector<int>> edge_joints() const {
    std::vector<std::vector<int>> joints(scene_.blocks.size());
    bool any = false;
    for (std::size_t b = 0; b < joints.size(); ++b) {
      const std::vector<int>& of_scene = scene_.blocks[b].edge_joints;
      for (const int edge : placed_[b].labels().edge)
        joints[b].push_back(of_scene.empty() ? -1 : of_scene[edge]);
      any = any || !of_scene.empty();
    }
    return any ? joints : std::vector<std::vector<int>>();
  }

  ContactProperties contact_properties() const {
    std::vector<int> materials;
    for (const BlockDescription& block : scene_.blocks) materials.push_back(block.material);
    return {scene_.contact.normal_stiffness,
            scene_.contact.tangential_stiffness,
            joint_table(first_stage().joints),
            std::move(materials),
            scene_.contact.method,
            scene_.contact.penetration_tolerance,
            scene_.analysis.preset == Preset::paper ? ContactProperties::lip_of_paper
                                                    : ContactProperties::default_lip,
            scene_.contact.tolerance,
            edge_joints()};
  }

  StageDescription first_stage() const {
    return scene_.stages.empty() ? scene_.stage("") : scene_.stages.front();
  }

  Water from_origin(Water water) const {
    for (Points* table : {&water.table, &water.joint_table}) table->colwise() -= origin_;
    return water;
  }

  std::vector<Stage> stages(const BlockSystem& system) const {
    std::vector<Stage> stages;
    const auto add = [&](const StageDescription& stage) {
      stages.push_back({stage.analysis, joint_table(stage.joints), stage.removed, stage.reset_displacements,
                        stage.until, stage.name, from_origin(stage.water), stage.bolts, stage.added,
                        stage.relax.value_or(0)});
      for (const int load : stage.loads) add_load(load, system, stages.back());
    };
    if (scene_.stages.empty()) add(scene_.stage(""));
    for (const StageDescription& stage : scene_.stages) add(stage);
    return stages;
  }

  const Scene& scene_;
  const std::vector<std::string>& reasons_;
  Vec2 origin_;
  CongruentShapes shapes_;
  std::map<std::pair<Index, bool>, std::shared_ptr<const OutlineLabels>> outline_labels_;
  std::vector<Placed> placed_;
  std::vector<Holds> holds_;
  std::vector<std::vector<LocalHold>> local_holds_ =
      std::vector<std::vector<LocalHold>>(scene_.blocks.size());
  std::vector<FixedVertex> springs_;
  BuiltScene built_;
};

ChosenModels choose(const Scene& scene) {
  return choose_models(scene, [](const Scene& stated, const std::vector<std::string>& reasons) {
    return Builder(stated, reasons).missing();
  });
}

}  // namespace

BuiltScene build(const Scene& scene) {
  const ChosenModels chosen = choose(scene);
  return Builder(chosen.scene, chosen.reasons).build();
}

Scene with_chosen_models(const Scene& scene) {
  return choose(scene).scene;
}

}  // namespace ddacontact
