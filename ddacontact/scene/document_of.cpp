#include <ddacontact/scene/document_of.hpp>

#include <set>

namespace ddacontact::scene_format {

namespace {

std::optional<std::string> optional_name(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional(name);
}

/// By name where there is one, else by index.
template <class Named>
Reference reference_to(int index, const std::vector<Named>& all) {
  const std::string& name = all[index].name;
  return name.empty() ? Reference{"", index} : Reference{name, std::nullopt};
}

MeshRecord record_of(const MeshOptions& mesh) {
  MeshRecord record;
  record.kind = mesh.kind;
  record.edge_nodes = mesh.edge_nodes;
  if (mesh.at_contact > 0) record.at_contact = mesh.at_contact;
  if (mesh.cell_size > 0)
    record.cell_size = mesh.cell_size;
  else
    record.cells = mesh.cells;
  return record;
}

AnalysisRecord record_of(const AnalysisOptions& analysis) {
  AnalysisRecord record;
  record.options = analysis;
  record.block_model = analysis.block_model;
  record.mesh = record_of(analysis.mesh);
  record.kinematics = analysis.kinematics;
  record.scheme = analysis.scheme;
  if (analysis.scheme == Scheme::newmark) {
    record.beta = analysis.beta;
    record.gamma = analysis.gamma;
  }
  record.gradient_correction = analysis.gradient_correction;
  record.cutting_factor = analysis.cutting_factor;
  return record;
}

ContactRecord record_of(const ContactOptions& contact) {
  ContactRecord record;
  record.options = contact;
  record.method = contact.method;
  record.normal_stiffness = contact.normal_stiffness;
  record.tangential_stiffness = contact.tangential_stiffness;
  record.penetration_tolerance = contact.penetration_tolerance;
  return record;
}

MaterialRecord record_of(const Material& material, const Scene&) {
  MaterialRecord record;
  record.name = material.name;
  record.density = material.density;
  record.young = material.young;
  record.poisson = material.poisson;
  return record;
}

JointRecord record_of(const Joint& joint, const Scene& scene) {
  JointRecord record;
  record.name = optional_name(joint.name);
  record.joint = joint;
  if (joint.between)
    record.between = std::array<Reference, 2>{reference_to((*joint.between)[0], scene.materials),
                                              reference_to((*joint.between)[1], scene.materials)};
  return record;
}

EdgeJoints record_of(const std::vector<int>& edge_joints, const Scene& scene) {
  EdgeJoints record;
  for (const int joint : edge_joints)
    record.joints.push_back(joint < 0 ? Reference() : reference_to(joint, scene.joints));
  return record;
}

BlockRecord record_of(const BlockDescription& block, const Scene& scene) {
  BlockRecord record;
  record.name = optional_name(block.name);
  record.material = reference_to(block.material, scene.materials);
  record.vertices.points = block.vertices;
  if (!block.edge_joints.empty()) record.edge_joints = record_of(block.edge_joints, scene);
  record.groups = block.groups;
  record.model = block.model;
  if (block.mesh != scene.analysis.mesh) record.mesh = record_of(block.mesh);
  record.fixed = {block.fixed, block.fixed_vertices};
  record.velocity = block.velocity;
  record.angular_velocity = block.angular_velocity;
  record.stress = block.stress;
  record.stress_gradient = block.stress_gradient;
  return record;
}

/// The function as a history, for keys that have no other word for it.
History history_of(TimeFunction function, double end_time) {
  History history;
  history.entries = function.history;
  function.rise = 0;
  const auto add = [&](double t) {
    const Vec2 value = function.at(t, end_time);
    history.entries.emplace_back(t, value.x(), value.y());
  };
  if (!function.is_history()) add(0);
  if (!function.is_history() && function.kind != TimeFunction::Kind::constant) add(end_time);
  return history;
}

SupportRecord record_of(const Support& support, const Scene& scene) {
  SupportRecord record;
  record.block = reference_to(support.block, scene.blocks);
  record.vertices.some = support.vertices;
  record.axes = support.fix_x && support.fix_y ? Axes::xy : support.fix_x ? Axes::x : Axes::y;
  using Kind = TimeFunction::Kind;
  const Kind kind = support.displacement.kind;
  if (kind == Kind::ramp)
    record.displacement = support.displacement.value;
  else if (kind == Kind::rate)
    record.velocity = support.displacement.value;
  else
    (kind == Kind::velocity_history       ? record.velocity_history
     : kind == Kind::acceleration_history ? record.acceleration_history
                                          : record.history) =
        history_of(support.displacement, scene.end_time());
  if (kind == Kind::smooth_history) record.interpolation = Interpolation::smooth;
  return record;
}

LoadRecord record_of(const Load& load, const Scene& scene) {
  LoadRecord record;
  if (!load.name.empty()) record.name = load.name;
  record.type = load.kind;
  record.block = reference_to(load.block, scene.blocks);
  if (load.kind == Load::Kind::point) record.at = load.at;
  const bool pressure = load.kind == Load::Kind::pressure;
  if (pressure) record.edge = EdgeSelection{load.edge};
  if (load.force.kind != TimeFunction::Kind::constant) {
    record.history = history_of(load.force, scene.end_time());
    record.history->columns = pressure ? 2 : 3;
  } else if (pressure) {
    record.value = load.force.value.x();
  } else {
    record.force = load.force.value;
  }
  if (load.force.rise > 0) record.ramp = load.force.rise;
  return record;
}

WaterRecord record_of(const Water& water) {
  WaterRecord record;
  if (water.table.cols() > 0) record.table = Outline{water.table, {}};
  record.density = water.density;
  record.joints = water.joint_table.cols() > 0;
  if (*record.joints) record.joint_table = Outline{water.joint_table, {}};
  return record;
}

QuietRecord record_of(const QuietBoundary& boundary, const Scene& scene) {
  QuietRecord record;
  record.on = {boundary.from, boundary.to};
  if (boundary.incoming.is_history()) record.incoming = history_of(boundary.incoming, scene.end_time());
  return record;
}

QuakeRecord record_of(const Quake& quake, const Scene&) {
  QuakeRecord record;
  record.acceleration.entries = quake.acceleration.history;
  return record;
}

BoltRecord record_of(const RockBolt& bolt, const Scene&) {
  BoltRecord record;
  record.name = bolt.name;
  record.points.points.resize(2, 2);
  record.points.points << bolt.from, bolt.to;
  record.bolt = bolt;
  if (bolt.kind == RockBolt::Kind::grouted) record.bond_stiffness = bolt.bond_stiffness;
  return record;
}

MonitorRecord record_of(const Monitor& monitor, const Scene& scene) {
  MonitorRecord record;
  record.name = monitor.name;
  record.block = reference_to(monitor.block, scene.blocks);
  if (monitor.kind == Monitor::Kind::vertex) record.vertex = monitor.vertex;
  if (monitor.kind == Monitor::Kind::centroid) record.at = Location{};
  if (monitor.kind == Monitor::Kind::point) record.at = Location{monitor.at};
  return record;
}

/// What of a joint is different while a stage lasts; nothing when all is the same.
std::optional<JointChange> change_of(int index, const Joint& joint, const Scene& scene) {
  const Joint& of_scene = scene.joints[index];
  JointChange change;
  bool any = false;
  for (const auto& [from, to] : joint_law) {
    if (joint.*from == of_scene.*from) continue;
    change.*to = joint.*from;
    any = true;
  }
  if (joint.restitution != of_scene.restitution) {
    change.restitution = joint.restitution;
    any = true;
  }
  if (joint.residual_friction_angle != of_scene.residual_friction_angle) {
    change.residual_friction_angle = joint.residual_friction_angle;
    any = true;
  }
  if (joint.glued) change.glued = any = true;
  if (!any) return std::nullopt;
  change.joint = reference_to(index, scene.joints);
  return change;
}

StageRecord record_of(const StageDescription& stage, const Scene& scene) {
  const AnalysisOptions& analysis = stage.analysis;
  StageRecord record;
  record.name = optional_name(stage.name);
  record.mode = analysis.mode;
  record.steps = analysis.steps;
  record.time_step = analysis.time_step;
  record.max_displacement_ratio = analysis.max_displacement_ratio;
  record.gravity = analysis.gravity;
  record.scheme = analysis.scheme;
  if (analysis.scheme == Scheme::newmark) {
    record.beta = analysis.beta;
    record.gamma = analysis.gamma;
  }
  record.damping = analysis.damping;
  record.cutting_factor = analysis.cutting_factor;
  for (std::size_t j = 0; j < stage.joints.size(); ++j)
    if (auto change = change_of(static_cast<int>(j), stage.joints[j], scene))
      record.joints.push_back(std::move(*change));
  record.reset_displacements = stage.reset_displacements;
  record.relax = stage.relax;
  record.until = stage.until;
  if (!(stage.water == scene.water)) record.water = record_of(stage.water);
  for (const int block : stage.removed) record.remove.blocks.push_back(reference_to(block, scene.blocks));
  for (const int bolt : stage.bolts) record.add.blocks.push_back(Reference{scene.bolts[bolt].name, {}});
  std::set<std::string> loads;
  for (const int load : stage.loads)
    if (const std::string& name = scene.loads[load].name; loads.insert(name).second)
      record.add.blocks.push_back(Reference{name, {}});
  for (const int block : stage.added) record.add.blocks.push_back(reference_to(block, scene.blocks));
  return record;
}

template <class Record, class Thing>
void fill(std::vector<Record>& records, const std::vector<Thing>& things, const Scene& scene) {
  records.reserve(things.size());
  for (const Thing& thing : things) records.push_back(record_of(thing, scene));
}

}  // namespace

Document document_of(const Scene& scene) {
  Document document;
  document.title = scene.title;
  document.analysis = record_of(scene.analysis);
  document.analysis.options.steps = scene.n_steps();
  document.contact = record_of(scene.contact);
  fill(document.materials, scene.materials, scene);
  fill(document.joints, scene.joints, scene);
  fill(document.blocks, scene.blocks, scene);
  fill(document.supports, scene.supports, scene);
  fill(document.loads, scene.loads, scene);
  if (scene.water.any()) document.water = record_of(scene.water);
  fill(document.quakes, scene.quakes, scene);
  fill(document.quiet_boundaries, scene.quiet_boundaries, scene);
  fill(document.bolts, scene.bolts, scene);
  fill(document.monitors, scene.monitors, scene);
  fill(document.stages, scene.stages, scene);
  document.solver.skip = scene.analysis.skip;
  document.output.options = scene.output;
  return document;
}

}  // namespace ddacontact::scene_format
