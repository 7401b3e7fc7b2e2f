#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/words.hpp>

#include <ddacontact/scene/bending_in_stages.hpp>
#include <ddacontact/scene/bent_faces.hpp>
#include <ddacontact/scene/block_maker.hpp>
#include <ddacontact/scene/bolt_path.hpp>
#include <ddacontact/scene/held_corners.hpp>
#include <ddacontact/scene/joint_strengths.hpp>
#include <ddacontact/scene/model_choice.hpp>
#include <ddacontact/scene/record_notes.hpp>
#include <ddacontact/scene/steep_water.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/unlikely_values.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace ddacontact {

namespace {

std::string model_name(BlockModel model) {
  const auto& words = scene_format::words_of(model);
  return std::ranges::find(words, model, &scene_format::Word<BlockModel>::choice)->text;
}

class Builder {
 public:
  /// \param[in] reasons  why blocks have the models that the scene states; empty: the user chose it
  Builder(const Scene& scene, const std::vector<std::string>& reasons)
      : scene_(scene), reasons_(reasons), origin_(low_corner(scene)) {
    for (std::size_t b = 0; b < scene.blocks.size(); ++b)
      placed_.push_back(placed_block(scene, static_cast<int>(b), origin_));
    holds_ = collect_holds(scene, placed_);
  }

  /// What of the stress in each block bends it and is missing, see missing_in_stages.
  std::vector<double> missing() {
    BlockSystem system = make_system();
    BlockState initial = system.initial_state();
    set_initial(system, initial);
    const std::vector<Stage> parts = stages(system);
    return missing_in_stages(system, std::move(initial), contact_properties(), parts);
  }

  BuiltScene build() {
    BlockSystem system = make_system();
    note_idle_velocities(system);
    note_domain();
    note_snapping();
    note_omissions(system);
    for (const auto& notes :
         {scene_format::notes_on_records(scene_), scene_format::notes_on_unlikely_values(scene_)})
      built_.notes.insert(built_.notes.end(), notes.begin(), notes.end());
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
    note_bent_joints();
    built_.labels.has_bolts = !scene_.bolts.empty();
    std::set<int> supported;
    for (const Support& support : scene_.supports) supported.insert(support.block);
    built_.labels.supported_blocks.assign(supported.begin(), supported.end());
    for (const Monitor& monitor : scene_.monitors)
      built_.monitor_targets.push_back(make_monitor_target(monitor, system));

    BlockState initial = system.initial_state();
    set_initial(system, initial);
    std::vector<Stage> parts = stages(system);
    if (auto note = note_on_bent_face(system, initial, held_corners(system, initial, parts)))
      built_.notes.push_back(std::move(*note));
    if (auto note = note_on_steep_water(system, initial, parts)) built_.notes.push_back(std::move(*note));
    built_.stepper = std::make_unique<Stepper>(std::move(system), std::move(initial), contact_properties(),
                                               std::move(parts));
    return std::move(built_);
  }

 private:
  BlockSystem make_system() {
    BlockMaker maker(scene_, placed_, holds_, built_.notes);
    std::vector<std::unique_ptr<Block>> blocks;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) blocks.push_back(maker.make(static_cast<int>(b)));
    BlockSystem system(std::move(blocks));
    system.round_corners(scene_.contact.corner_rounding);
    system.compute_fixed(!scene_.analysis.skip.fixed_blocks);
    hold(maker, system);
    system.gravity = scene_.analysis.gravity;
    system.end_time = scene_.end_time();
    add_loads(system);
    add_quiet_faces(system);
    for (const Quake& quake : scene_.quakes) system.ground.push_back(zero_outside(quake.acceleration));
    system.set_bolts(bolts(system));
    return system;
  }

  /// The same for all outlines of so many vertices in the same sense.
  std::shared_ptr<const OutlineLabels> outline_labels(const PlacedBlock& placed) {
    if (placed.mesh) return std::make_shared<const OutlineLabels>(placed.labels());
    auto& labels = outline_labels_[{placed.outline.cols(), placed.turned}];
    if (!labels) labels = std::make_shared<const OutlineLabels>(placed.labels());
    return labels;
  }

  void hold(const BlockMaker& made, BlockSystem& system) const {
    std::vector<PrescribedDof> prescribed;
    for (int b = 0; b < system.n_blocks(); ++b) {
      const Block& block = system.block(b);
      for (const LocalHold& hold : made.local_holds[b])
        prescribed.push_back({block.unknowns().first + hold.unknown, block.vertices().first + hold.vertex,
                              hold.axis, hold.motion});
    }
    system.set_prescribed_dofs(std::move(prescribed));
    system.fixed_vertices = made.springs;
    for (int b = 0; b < system.n_blocks(); ++b)
      for (std::size_t v = 0; v < holds_[b].vertices.size(); ++v)
        if (holds_[b].vertices[v][0] || holds_[b].vertices[v][1])
          system.supported_vertices.push_back(system.block(b).points().first +
                                              placed_[b].point(static_cast<int>(v)));
  }

  void note_idle_velocities(const BlockSystem& system) {
    const bool from_rest = first_stage().analysis.mode == Mode::statics;
    for (int b = 0; b < system.n_blocks(); ++b) {
      const BlockDescription& block = scene_.blocks[b];
      if (block.velocity.isZero(0) && block.angular_velocity == 0) continue;
      if (!system.is_movable(b) || from_rest)
        built_.notes.push_back("block \"" + scene_.block_name(b) + "\" " +
                               (system.is_movable(b) ? "starts with static steps" : "is held") +
                               ": its initial velocity has no effect");
    }
  }

  /// Two contacts at the ends of a face have the stiffness and strength of the face, and three times its
  /// resistance to turning.
  void note_bent_joints() {
    const std::vector<Joint> joints = first_stage().joints;
    const auto resists = std::ranges::find_if(joints, [](const Joint& joint) {
      return joint.normal_stiffness.has_value() || joint.tensile_strength > 0;
    });
    const bool undivided = std::ranges::any_of(scene_.blocks, [](const BlockDescription& block) {
      return !block.fixed && block.model != BlockModel::mesh;
    });
    if (resists == joints.end() || !undivided) return;
    built_.notes.push_back(
        "the " + std::string(resists->normal_stiffness ? "stiffness" : "tensile strength") + " of joint " +
        scene_format::quoted(built_.labels.joint_names[resists - joints.begin()]) +
        " acts at both ends of a face between blocks that are not meshed: bent, such a face "
        "resists three times as much as along its whole length (model = \"mesh\" where "
        "joints bend)");
  }

  /// What scenes are rarely meant to be without.
  void note_omissions(const BlockSystem& system) {
    const Joint& joint = scene_.joints[0];
    if (scene_.joints.size() == 1 && joint.name == "default" && joint.friction_angle == 0 &&
        joint.cohesion == 0)
      built_.notes.push_back("without any [[joint]] all contacts are frictionless");
    bool held = scene_.water.any() || !system.bolts.empty() || !system.quiet_faces.empty() ||
                !system.fixed_vertices.empty() || !system.prescribed_dofs().empty();
    for (int b = 0; b < system.n_blocks(); ++b) held = held || !system.is_movable(b);
    if (!held && !system.gravity.isZero(0))
      built_.notes.push_back("nothing is held: all blocks fall ('fixed' of a [[block]], or a [[support]])");
  }

  void note_domain() {
    if (!scene_.domain) return;
    const DomainCounts& cut = *scene_.domain;
    const auto n = [](int count) { return std::to_string(count); };
    built_.notes.push_back(
        "the domain is cut into " + n(cut.blocks) + " blocks: slivers merged " + n(cut.slivers_merged) +
        ", left " + n(cut.slivers_left) + "; dead ends of joints removed " + n(cut.dangling_removed) +
        "; connecting joints added " + n(cut.connecting_joints) + "; T-vertices " + n(cut.t_vertices));
    if (cut.cut_by_longer > 0)
      built_.notes.push_back(
          "lines of joints that were a twentieth longer would cut " + n(cut.cut_by_longer) +
          " blocks more: they end before the line that they mean, and divide nothing there "
          "('snap' in [domain] as large as what is missing)");
  }

  void note_snapping() {
    if (scene_.snapped)
      built_.notes.push_back("'snap' moved vertices: " + std::to_string(scene_.snapped->moved) + ", by " +
                             scene_format::rounded(scene_.snapped->farthest) +
                             " m at most; gaps that were meant, of that size, are closed too");
  }

  /// visit(edge) for all edges of the block, as it numbers them, that an edge of the scene is divided into.
  template <class Visit>
  static void for_parts(const Block& block, const PlacedBlock& on, int scene_edge, Visit&& visit) {
    const int n = static_cast<int>(on.outline.cols());
    const int edge = on.turned ? (2 * n - 2 - scene_edge) % n : scene_edge;
    const int end = edge + 1 < n ? on.point(edge + 1) : block.n_vertices();
    for (int part = on.point(edge); part < end; ++part) visit(part);
  }

  /// At the start, at points from the centroid.
  static Tensors stresses_at(const BlockDescription& block, const PointsRef& from_centroid) {
    return (block.stress_gradient * from_centroid.row(1)).colwise() + block.stress;
  }

  void add_quiet_faces(BlockSystem& system) const {
    for (const QuietBoundary& boundary : scene_.quiet_boundaries)
      for (const auto& [block, edge] : boundary.faces)
        for_parts(system.block(block), placed_[block], edge, [&, b = block](int part) {
          const Block& on = system.block(b);
          const int ends[] = {part, (part + 1) % on.n_vertices()};
          const Points from_centroid =
              on.reference()(Eigen::all, ends).colwise() -
              polyfem::area_moments(on.reference().leftCols(on.n_vertices())).centroid;
          system.quiet_faces.push_back(
              {b, part, stresses_at(scene_.blocks[b], from_centroid), boundary.incoming});
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
    const PlacedBlock& on = placed_[load.block];
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
      if (!made.is_grouted()) made.buckling = euler_load(bolt) / bolt.spacing;
    }
    return all;
  }

  MonitorTarget make_monitor_target(const Monitor& monitor, const BlockSystem& system) const {
    const PlacedBlock& on = placed_[monitor.block];
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
    system.reshape(initial, true);
    bool stressed = false;
    for (int b = 0; b < system.n_blocks(); ++b)
      stressed = stressed || system.block(b).changes_stress() || !scene_.blocks[b].stress.isZero(0) ||
                 !scene_.blocks[b].stress_gradient.isZero(0);
    if (!stressed) initial.stress.resize(3, 0);
    for (int b = 0; b < system.n_blocks(); ++b) {
      const BlockDescription& description = scene_.blocks[b];
      const Block& block = system.block(b);
      if (stressed)
        initial.stress.middleCols(block.stress_points().first, block.stress_points().count) =
            stresses_at(description, block.integration_points());
      if (first_stage().analysis.mode == Mode::statics) continue;
      const Vec3 rigid(description.velocity.x(), description.velocity.y(), description.angular_velocity);
      initial.velocity.segment(block.unknowns().first, block.unknowns().count) =
          block.rigid_modes(initial) * rigid;
    }
    const AnalysisOptions& first = first_stage().analysis;
    for (const PrescribedDof& held : system.prescribed_dofs())
      initial.velocity[held.unknown] =
          first.mode == Mode::statics
              ? 0
              : held.motion.rate_at_start(first.time_step, system.end_time)[held.axis];
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
  std::map<std::pair<Index, bool>, std::shared_ptr<const OutlineLabels>> outline_labels_;
  std::vector<PlacedBlock> placed_;
  std::vector<Holds> holds_;
  BuiltScene built_;
};

ChosenModels choose(const Scene& scene, const std::function<void()>& in_between) {
  return choose_models(scene, [&](const Scene& stated, const std::vector<std::string>& reasons) {
    in_between();
    return Builder(stated, reasons).missing();
  });
}

}  // namespace

BuiltScene build(const Scene& scene, const std::function<void()>& in_between) {
  const ChosenModels chosen = choose(scene, in_between);
  in_between();
  return Builder(chosen.scene, chosen.reasons).build();
}

Scene with_chosen_models(const Scene& scene) {
  return choose(scene, [] {}).scene;
}

}  // namespace ddacontact
