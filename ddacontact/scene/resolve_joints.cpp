#include <ddacontact/scene/resolve_joints.hpp>

#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <set>
#include <string>

namespace ddacontact::scene_format {

namespace {

/// Springs let blocks bounce as they please: only the method "staged" gives the stated value.
void check_restitution(std::optional<double> restitution, const KeyLocations& locations,
                       const ContactRecord& contact, ContactMethod method, ProblemList& problems) {
  if (method != ContactMethod::classic || !restitution || *restitution == 0) return;
  if (!locations.good("restitution") || !contact.locations.usable("method")) return;
  problems.error(locations.of("restitution"),
                 "'restitution' = '" + short_number(*restitution) + "' needs the contact method 'staged'",
                 "leave it out, or write method = \"staged\" in [contact]");
}

void check_method(const char* key, const KeyLocations& locations, ContactMethod method,
                  ProblemList& problems) {
  if (method == ContactMethod::classic)
    problems.error(locations.of(key), "'" + std::string(key) + "' needs the contact method 'staged'",
                   "leave it out, or write method = \"staged\" in [contact]");
}

/// A joint has both springs or none.
void check_springs(const Joint& joint, const KeyLocations& locations, ContactMethod method,
                   ProblemList& problems) {
  const bool normal = joint.normal_stiffness && locations.good("normal_stiffness"),
             shear = joint.shear_stiffness && locations.good("shear_stiffness");
  if (normal) check_method("normal_stiffness", locations, method, problems);
  if (normal && !joint.shear_stiffness)
    problems.error(locations.of("normal_stiffness"), "'normal_stiffness' without 'shear_stiffness'",
                   "add 'shear_stiffness' in Pa/m: a joint is rigid in both directions or in none");
  if (shear && !joint.normal_stiffness)
    problems.error(locations.of("shear_stiffness"), "'shear_stiffness' without 'normal_stiffness'",
                   "add 'normal_stiffness' in Pa/m: a joint is rigid in both directions or in none");
}

/// The springs of a joint throw off what meets.
void check_rebound(const Joint& joint, const std::optional<double>& restitution,
                   const KeyLocations& locations, ProblemList& problems) {
  if (joint.normal_stiffness && restitution && locations.good("restitution"))
    problems.error(locations.of("restitution"), "'restitution' of a joint that has a stiffness",
                   "leave it out: the joint's springs make blocks rebound, a 'dashpot' damps them");
}

/// What slips does not become stronger.
void check_residual(const Joint& joint, const SourceLocation& location, ProblemList& problems) {
  if (joint.residual_friction_angle.value_or(0) > joint.friction_angle)
    problems.error(location,
                   "'residual_friction_angle' = '" + short_number(*joint.residual_friction_angle) +
                       "' is larger than 'friction_angle', " + short_number(joint.friction_angle),
                   "it is the friction of what has slipped: make it smaller, or leave it out");
}

/// What rises does so by the work of friction.
void check_lift(const Joint& joint, const SourceLocation& location, ProblemList& problems) {
  const double friction = joint.residual_friction_angle.value_or(joint.friction_angle);
  if (joint.dilation_angle.value_or(0) > friction)
    problems.error(location,
                   "'dilation_angle' = '" + short_number(*joint.dilation_angle) +
                       "' is larger than the angle of friction once it slides, " + short_number(friction),
                   "friction has to do the work that lifts the block: make it smaller");
}

void check_dilation(const Joint& joint, const KeyLocations& locations, ContactMethod method,
                    ProblemList& problems) {
  if (joint.dilation_slip && !joint.dilation_angle && locations.good("dilation_slip"))
    problems.error(locations.of("dilation_slip"), "'dilation_slip' without 'dilation_angle'",
                   "add 'dilation_angle' in degrees, or leave it out");
  if (!joint.dilation_angle || !locations.good("dilation_angle")) return;
  check_method("dilation_angle", locations, method, problems);
  if (!joint.dilation_slip)
    problems.error(locations.of("dilation_angle"), "'dilation_angle' without 'dilation_slip'",
                   "add 'dilation_slip', the slip in m up to which the joint dilates");
  if (locations.usable("friction_angle") && locations.usable("residual_friction_angle"))
    check_lift(joint, locations.of("dilation_angle"), problems);
}

/// By the law of Coulomb a bond without cohesion bears no shear where it is pulled.
void warn_of_bond(const Joint& joint, const KeyLocations& locations, ContactMethod method,
                  ProblemList& problems) {
  if (method == ContactMethod::staged && joint.tensile_strength > 0 && joint.friction_angle > 0 &&
      joint.cohesion == 0 && locations.good("tensile_strength"))
    problems.warning(
        locations.of("tensile_strength"),
        "'tensile_strength' without 'cohesion': where it is pulled such a bond breaks by the least shear",
        "add 'cohesion', of bonded faces at least tensile_strength x tan(friction_angle)");
}

/// What is crushed at corners moves the forces of sharp ones, and of blocks that have nothing between them.
void check_crushing(const Joint& joint, const KeyLocations& locations, const Document& document,
                    ContactMethod method, ProblemList& problems) {
  if (!joint.compressive_strength || !locations.good("compressive_strength")) return;
  const SourceLocation& location = locations.of("compressive_strength");
  check_method("compressive_strength", locations, method, problems);
  if (joint.normal_stiffness)
    problems.error(location, "'compressive_strength' of a joint that has a stiffness",
                   "leave one of them out: what is crushed is shifted with the force, at once");
  if (document.contact.options.corner_rounding > 0)
    problems.error(location, "'compressive_strength' with 'corner_rounding'",
                   "leave one of them out: forces of rounded corners act where the arcs touch");
  const BlockModel default_model = document.analysis.block_model.value_or(BlockModel::automatic);
  if (std::ranges::any_of(document.blocks, [&](const BlockRecord& block) {
        return block.model.value_or(default_model) == BlockModel::mesh;
      }))
    problems.error(location, "'compressive_strength' in a scene with blocks of model 'mesh'",
                   "leave their model out: the strength is that of a joint between two corners");
}

/// A scene without joints may name the one that it has all the same.
void add_default_joint(NamedJoints& table, ProblemList& problems) {
  Joint& joint = table.joints.emplace_back();
  joint.name = "default";
  KeyLocations locations;
  locations.add("name", {}, true);
  table.names.add(joint.name, locations, problems);
}

/// The joints that edges of blocks name.
std::set<std::string> joints_of_edges(const Document& document) {
  std::set<std::string> names;
  for (const BlockRecord& block : document.blocks) {
    if (!block.edge_joints) continue;
    for (const Reference& joint : block.edge_joints->joints)
      names.insert(joint.index ? std::to_string(*joint.index) : joint.name);
  }
  return names;
}

}  // namespace

NamedJoints resolve_joints(const Document& document, const NameTable& materials, ContactMethod method,
                           ProblemList& problems) {
  NamedJoints table;
  std::vector<Joint>& joints = table.joints;
  const std::set<std::string> of_edges = joints_of_edges(document);
  for (const JointRecord& record : document.joints) {
    const KeyLocations& locations = record.locations;
    table.names.add(record.name, locations, problems);
    Joint joint = record.joint;
    joint.name = record.name.value_or("");
    check_restitution(joint.restitution, locations, document.contact, method, problems);
    check_springs(joint, locations, method, problems);
    check_rebound(joint, joint.restitution, locations, problems);
    if (locations.usable("friction_angle") && locations.usable("residual_friction_angle"))
      check_residual(joint, locations.of("residual_friction_angle"), problems);
    check_dilation(joint, locations, method, problems);
    warn_of_bond(joint, locations, method, problems);
    check_crushing(joint, locations, document, method, problems);
    if (record.between && locations.good("between")) {
      const int a = materials.find((*record.between)[0], locations.of("between"), problems);
      const int b = materials.find((*record.between)[1], locations.of("between"), problems);
      if (a >= 0 && b >= 0) joint.between = std::array<int, 2>{std::min(a, b), std::max(a, b)};
      for (std::size_t other = 0; joint.between && other < joints.size(); ++other)
        if (joints[other].between == joint.between)
          problems.error(locations.of("between"),
                         "the two materials already follow " + table.names.title(static_cast<int>(other)),
                         "leave one 'between' out");
    } else if (!record.between && document.has_all_blocks &&
               !std::ranges::all_of(joints, [](const Joint& before) { return before.between.has_value(); }) &&
               !of_edges.contains(record.name.value_or(std::to_string(joints.size())))) {
      problems.warning(
          locations.table,
          table.names.title(table.names.size() - 1) +
              " is never used: it has no 'between', no edge names it, and only the first joint without "
              "'between' is the default",
          "add 'between', or name it in [domain] or 'edge_joints'");
    }
    joints.push_back(std::move(joint));
  }
  if (joints.empty()) add_default_joint(table, problems);
  return table;
}

std::vector<Joint> changed_joints(const StageRecord& stage, const NamedJoints& of_scene,
                                  const ContactRecord& contact, ContactMethod method, ProblemList& problems) {
  std::vector<Joint> joints = of_scene.joints;
  std::vector<bool> is_changed(joints.size(), false);
  for (const JointChange& change : stage.joints) {
    check_restitution(change.restitution, change.locations, contact, method, problems);
    const int index = of_scene.names.find(change.joint, change.locations.table, problems);
    if (index < 0) continue;
    if (is_changed[index])
      problems.error(change.locations.table, of_scene.names.title(index) + " stands twice in 'joints'",
                     "write all of its keys in one place");
    is_changed[index] = true;
    for (const auto& [of_joint, of_change] : joint_law)
      joints[index].*of_joint = (change.*of_change).value_or(joints[index].*of_joint);
    if (change.restitution) joints[index].restitution = change.restitution;
    if (change.residual_friction_angle)
      joints[index].residual_friction_angle = change.residual_friction_angle;
    joints[index].glued = change.glued.value_or(false);
    check_residual(joints[index], change.locations.table, problems);
    check_rebound(joints[index], change.restitution, change.locations, problems);
    if (change.friction_angle || change.residual_friction_angle)
      check_lift(joints[index], change.locations.table, problems);
  }
  return joints;
}

}  // namespace ddacontact::scene_format
