/// \file Every key of the scene format, declared once.
///
/// `describe(record, visit)` calls visit(Key, member) for each key of a table in the order of the format. The
/// reader fills the members, the writer writes them, the documentation prints the keys with the defaults that
/// a fresh record has, and --set looks up names.
#pragma once

#include <ddacontact/scene/domain_schema.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/preset_defaults.hpp>
#include <ddacontact/scene/records.hpp>

#include <string>

namespace ddacontact::scene_format {

/// Keys of [analysis] that a stage may override.
namespace analysis_keys {

inline constexpr Key mode{.name = "mode", .what = "Velocities carry over, or every step starts at rest."};
inline constexpr Key time_step{.name = "time_step",
                               .what = "The largest step taken.",
                               .unit = "s",
                               .bounds = positive,
                               .required = true};
inline constexpr Key max_displacement_ratio{.name = "max_displacement_ratio",
                                            .what =
                                                "Largest displacement of a vertex in a step over half the "
                                                "larger side of the scene's bounding box at the start.",
                                            .bounds = positive};
inline constexpr Key gravity{.name = "gravity", .what = "Acceleration of every block.", .unit = "m/s2"};
inline constexpr Key scheme{.name = "scheme",
                            .what =
                                "Time scheme; static steps of \"midpoint\" are made by "
                                "\"backward_euler\", those of \"explicit\" by \"decaying\"."};
inline constexpr Key beta{.name = "beta",
                          .what = "Of the scheme \"newmark\"; at least half of `gamma`.",
                          .bounds = positive,
                          .default_text = "(`gamma` + 1/2)^2 / 4"};
inline constexpr Key gamma{.name = "gamma",
                           .what = "Of the scheme \"newmark\".",
                           .bounds = {.low = 0.5, .high = 1000},
                           .default_text = "`0.5`"};
inline constexpr Key damping{
    .name = "damping",
    .what = "Rayleigh damping: forces `mass` x M v and `stiffness` x K times the rate of deformation.",
    .unit = "1/s and s",
    .bounds = not_negative};
inline constexpr Key cutting_factor{.name = "cutting_factor",
                                    .what = "A rejected step is repeated with this times its length.",
                                    .bounds = {.low = 0, .high = 1, .with_low = false, .with_high = false}};

}  // namespace analysis_keys

constexpr Key with_default(Key key, const char* text) {
  key.default_text = text;
  return key;
}

/// The same key where it overrides that of [analysis].
constexpr Key in_stage(Key key) {
  key.required = false;
  key.default_text = "as in `[analysis]`";
  return key;
}

template <class Visit>
void describe(AnalysisRecord& r, Visit&& visit) {
  static const std::string kinematics = preset_text(&Defaults::kinematics),
                           scheme = preset_text(&Defaults::scheme) +
                                    "; where that needs other `kinematics`: `\"dda\"`",
                           correction = preset_text(&Defaults::gradient_correction),
                           cutting = preset_text(&Defaults::cutting_factor),
                           model = preset_text(&Defaults::block_model);
  AnalysisOptions& o = r.options;
  visit(Key{.name = "preset", .what = "Chooses the defaults of keys left out."}, o.preset);
  visit(analysis_keys::mode, o.mode);
  visit(Key{.name = "steps",
            .what =
                "Number of steps of the length `time_step`. With `[[stage]]` it is neither needed nor used.",
            .bounds = at_least_one,
            .required = !r.in_stages},
        o.steps);
  visit(analysis_keys::time_step, o.time_step);
  visit(analysis_keys::max_displacement_ratio, o.max_displacement_ratio);
  visit(analysis_keys::gravity, o.gravity);
  visit(Key{.name = "plane", .what = "Plane strain or plane stress."}, o.plane);
  visit(Key{.name = "block_model",
            .what = "Model of every block that names none.",
            .default_text = model.c_str()},
        r.block_model);
  visit(Key{.name = "mesh",
            .what = "How blocks of the model \"mesh\" are divided: about `cells` cells, or as many as are of "
                    "`cell_size` metres; down to `at_contact` metres where they touch others.",
            .default_text = "`{ kind = \"auto\", cells = 64, edge_nodes = true }`"},
        r.mesh);
  visit(Key{.name = "kinematics",
            .what = "Displacements from the reference shape in a frame that turns with the block, or "
                    "increments on the current shape.",
            .default_text = kinematics.c_str()},
        r.kinematics);
  visit(with_default(analysis_keys::scheme, scheme.c_str()), r.scheme);
  visit(analysis_keys::beta, r.beta);
  visit(analysis_keys::gamma, r.gamma);
  visit(analysis_keys::damping, o.damping);
  visit(
      Key{.name = "gradient_correction",
          .what = "Whether shape function gradients are corrected so that the patch test holds to round-off.",
          .default_text = correction.c_str()},
      r.gradient_correction);
  visit(with_default(analysis_keys::cutting_factor, cutting.c_str()), r.cutting_factor);
}

template <class Visit>
void describe(ContactRecord& r, Visit&& visit) {
  static const std::string method = preset_text(&Defaults::method);
  visit(Key{.name = "method",
            .what = "Augmented Lagrangian (\"staged\"), or penalty springs with Shi's open-close iteration "
                    "(\"classic\").",
            .default_text = method.c_str()},
        r.method);
  visit(Key{.name = "normal_stiffness",
            .what = "Stiffness of the normal contact springs, per metre of thickness. Of \"staged\" it only "
                    "scales the `dashpot` of joints without a stiffness.",
            .unit = "N/m2",
            .other_unit = "N/m",
            .bounds = positive,
            .default_text = "40 x the largest `young`"},
        r.normal_stiffness);
  visit(Key{.name = "tangential_stiffness",
            .what = "Stiffness of the tangential contact springs, likewise.",
            .unit = "N/m2",
            .other_unit = "N/m",
            .bounds = positive,
            .default_text = "`normal_stiffness` / 2.5"},
        r.tangential_stiffness);
  visit(Key{.name = "penetration_tolerance",
            .what = "Largest penetration over the block size; gaps of closed contacts up to a thousandth of "
                    "it stay uncorrected. 0: the plain penalty method.",
            .bounds = not_negative,
            .default_text = "`1e-06`; method \"classic\": `0.0`"},
        r.penetration_tolerance);
  visit(Key{.name = "corner_rounding",
            .what = "Radius of the corners over the size of the smaller block; 0: sharp corners.",
            .bounds = not_negative,
            .default_text = "`0.0`"},
        r.options.corner_rounding);
  visit(
      Key{.name = "tolerance",
          .what =
              "Largest residual over the forces on its block. Above the default it is that of explicit steps "
              "and "
              "of those with many changes of contact state alone: these are faster, with up to ten times the "
              "penetration; method \"staged\" alone.",
          .bounds = {.low = 1e-12, .high = 1e-2},
          .default_text = "`1e-08`; in explicit steps `0.001`"},
      r.options.tolerance);
}

template <class Visit>
void describe(MaterialRecord& r, Visit&& visit) {
  visit(Key{.name = "name", .what = "What blocks call it; unique.", .required = true}, r.name);
  visit(Key{.name = "density",
            .what = "Mass per volume; or `unit_weight`.",
            .unit = "kg/m3",
            .bounds = positive,
            .default_text = "this or `unit_weight` is required"},
        r.density);
  visit(Key{.name = "unit_weight",
            .what = "Weight per volume, divided by the length of `gravity` to give the density.",
            .unit = "N/m3",
            .bounds = positive,
            .default_text = "this or `density` is required"},
        r.unit_weight);
  visit(Key{.name = "young", .what = "Young's modulus.", .unit = "Pa", .bounds = positive, .required = true},
        r.young);
  visit(Key{.name = "poisson",
            .what = "Poisson's ratio.",
            .bounds = {.low = 0, .high = 0.5, .with_high = false},
            .required = true},
        r.poisson);
}

/// The keys that joints and what stages change of them have in common.
template <class Law, class Visit>
void describe_law(Law& law, Visit&& visit) {
  visit(Key{.name = "friction_angle",
            .what = "Angle of friction.",
            .unit = "deg",
            .bounds = {.low = 0, .high = 90, .with_high = false}},
        law.friction_angle);
  visit(Key{.name = "cohesion",
            .what = "Cohesion of contacts closed at the start, lost on sliding or opening.",
            .unit = "Pa",
            .bounds = not_negative},
        law.cohesion);
  visit(Key{.name = "tensile_strength",
            .what = "Tensile strength of contacts closed at the start, lost on sliding or opening.",
            .unit = "Pa",
            .bounds = not_negative},
        law.tensile_strength);
  visit(Key{.name = "restitution",
            .what = "Normal velocity after an impact over that before, as between rigid bodies; method "
                    "\"staged\" alone.",
            .bounds = {.low = 0, .high = 1},
            .default_text =
                "none: blocks rebound by their elasticity (\"decaying\", \"explicit\"); `0.0` (others)"},
        law.restitution);
  visit(Key{.name = "dashpot",
            .what = "Damping of closed contacts: the ratio to critical damping with which a block on their "
                    "springs vibrates.",
            .bounds = not_negative},
        law.dashpot);
  visit(Key{.name = "residual_friction_angle",
            .what = "Angle of friction of contacts that have slid or opened, or closed after the start.",
            .unit = "deg",
            .bounds = {.low = 0, .high = 90, .with_high = false},
            .default_text = "that of `friction_angle`"},
        law.residual_friction_angle);
}

/// The keys of joints that are the same in all stages.
template <class Law, class Visit>
void describe_springs(Law& law, Visit&& visit) {
  visit(
      Key{.name = "normal_stiffness",
          .what = "Normal stiffness of the joint: pressure over closure. Needs `shear_stiffness` and method "
                  "\"staged\".",
          .unit = "Pa/m",
          .bounds = positive,
          .default_text = "none: the joint is rigid"},
      law.normal_stiffness);
  visit(Key{.name = "shear_stiffness",
            .what = "Shear stiffness of the joint: shear stress over slip.",
            .unit = "Pa/m",
            .bounds = positive,
            .default_text = "none: the joint is rigid"},
        law.shear_stiffness);
  visit(Key{.name = "dilation_angle",
            .what = "A slipping contact rises by the tangent of this angle times its slip; method \"staged\" "
                    "alone.",
            .unit = "deg",
            .bounds = {.low = 0, .high = 90, .with_high = false},
            .default_text = "none: joints do not dilate"},
        law.dilation_angle);
  visit(Key{.name = "dilation_slip",
            .what = "The slip up to which a joint dilates.",
            .unit = "m",
            .bounds = positive,
            .default_text = "required with `dilation_angle`"},
        law.dilation_slip);
  visit(Key{.name = "compressive_strength",
            .what = "Of the blocks at the joint: a contact force N acts N / (2 `compressive_strength`) away "
                    "from a corner; method \"staged\" alone.",
            .unit = "Pa",
            .bounds = positive,
            .default_text = "none: unlimited"},
        law.compressive_strength);
}

inline constexpr Key glued{.name = "glued",
                           .what = "Contacts that are closed, or close, neither open nor slide."};

/// What a stage may change of a joint.
template <class Change, class Visit>
void describe_change(Change& change, Visit&& visit) {
  describe_law(change, visit);
  visit(glued, change.glued);
}

template <class Visit>
void describe(JointRecord& r, Visit&& visit) {
  visit(Key{.name = "name",
            .what = "Unique; the first joint without 'between' is the law of all contacts that no other "
                    "one names.",
            .default_text = "none"},
        r.name);
  visit(Key{.name = "between",
            .what = "The two materials (either order) whose contacts follow it. Where every joint has it, "
                    "the first is "
                    "the law of all other contacts too.",
            .default_text = "everything not named elsewhere"},
        r.between);
  describe_law(r.joint, visit);
  describe_springs(r.joint, visit);
  visit(glued, OfStages{});
}

template <class Visit>
void describe(BlockRecord& r, Visit&& visit) {
  visit(Key{.name = "name",
            .what = "Unique; a block without a name is known by its index, counted from 0.",
            .default_text = "none"},
        r.name);
  visit(Key{.name = "material", .what = "Name of its material.", .required = true}, r.material);
  visit(Key{.name = "vertices",
            .what = "Corners of a polygon in either orientation; edge k runs from vertex k to vertex k + 1.",
            .unit = "m",
            .required = true},
        r.vertices);
  visit(Key{.name = "edge_joints",
            .what = "The joint that contacts on each edge follow, \"\": that of the materials.",
            .default_text = "those of the materials"},
        r.edge_joints);
  visit(Key{.name = "group", .what = "Names of groups that it belongs to.", .default_text = "none"},
        r.groups);
  visit(
      Key{.name = "grid",
          .what = "Copies, `count` in a row and in rows above each other, each a `step` further; every other "
                  "row is shifted by `bond` times the step. They are named NAME.0.0, NAME.1.0, ...",
          .unit = "m",
          .default_text = "none"},
      r.grid);
  visit(Key{.name = "model", .what = "How it deforms.", .default_text = "`analysis.block_model`"}, r.model);
  visit(Key{.name = "mesh",
            .what = "How it is divided when its model is \"mesh\".",
            .default_text = "`analysis.mesh`, key by key"},
        r.mesh);
  visit(Key{.name = "fixed", .what = "Vertices held in x and y."}, r.fixed);
  visit(Key{.name = "velocity", .what = "At the start.", .unit = "m/s"}, r.velocity);
  visit(Key{.name = "angular_velocity",
            .what = "At the start, about the centroid, counter-clockwise.",
            .unit = "rad/s"},
        r.angular_velocity);
  visit(Key{.name = "stress", .what = "At the start, at the centroid, tension positive.", .unit = "Pa"},
        r.stress);
  visit(Key{.name = "stress_gradient", .what = "Change of `stress` per metre upwards.", .unit = "Pa/m"},
        r.stress_gradient);
}

template <class Visit>
void describe(SupportRecord& r, Visit&& visit) {
  visit(Key{.name = "block", .what = "The block, or those a selector finds.", .required = true}, r.block);
  visit(Key{.name = "vertices", .what = "The vertices held.", .required = true}, r.vertices);
  visit(Key{.name = "axes", .what = "The directions held."}, r.axes);
  visit(Key{.name = "displacement",
            .what =
                "Reached linearly over `steps` x `time_step`, with `[[stage]]` over all of them, then held.",
            .unit = "m",
            .default_text = "[0.0, 0.0]; or `velocity` or `history`"},
        r.displacement);
  visit(Key{.name = "velocity", .what = "Of the held vertices.", .unit = "m/s", .default_text = "none"},
        r.velocity);
  visit(Key{.name = "history",
            .what = "Displacement in time, constant outside the entries: see `interpolation`.",
            .unit = "m",
            .default_text = "none"},
        r.history);
  visit(Key{.name = "velocity_history",
            .what = "Velocity in time, linear between entries; at rest before them, and on with the last.",
            .unit = "m/s",
            .default_text = "none"},
        r.velocity_history);
  visit(Key{.name = "acceleration_history",
            .what = "Acceleration in time, linear between entries; at rest before them, none after them.",
            .unit = "m/s2",
            .default_text = "none"},
        r.acceleration_history);
  visit(
      Key{.name = "interpolation",
          .what = "Of `history`: lines between the entries, or a cubic spline at rest before and after them.",
          .default_text = "`\"linear\"` in a table, `\"smooth\"` in a file"},
      r.interpolation);
}

template <class Visit>
void describe(LoadRecord& r, Visit&& visit) {
  visit(Key{.name = "name",
            .what = "What `add` of a stage calls it; several may share one.",
            .default_text = "none"},
        r.name);
  visit(Key{.name = "type", .what = "At a point, on an edge, or per volume.", .required = true}, r.type);
  const bool body = r.type == Load::Kind::body;
  visit(Key{.name = "block", .what = "The block, or those a selector finds.", .required = true}, r.block);
  visit(Key{.name = "at",
            .what = "point: where at the start; travels with the block.",
            .unit = "m",
            .default_text = "required by \"point\""},
        r.at);
  visit(Key{.name = "edge", .what = "pressure: the edge.", .default_text = "required by \"pressure\""},
        r.edge);
  visit(Key{.name = "value",
            .what = "pressure: pushes into the block when > 0.",
            .unit = "Pa",
            .default_text = "this or `history` is required by \"pressure\""},
        r.value);
  visit(Key{.name = "force",
            .what = "point: per metre of thickness; body: per volume, in N/m3.",
            .unit = body ? "N/m3" : "N/m",
            .other_unit = body ? "" : "N",
            .default_text = "this or `history` is required by \"point\" and \"body\""},
        r.force);
  const bool pressure = r.type == Load::Kind::pressure;
  visit(
      Key{.name = "history",
          .what = "The force in time, or entries [t, value] of a pressure; linear between entries, constant "
                  "outside.",
          .unit = pressure ? "Pa"
                  : body   ? "N/m3"
                           : "N/m",
          .other_unit = pressure || body ? "" : "N",
          .default_text = "none"},
      r.history);
  visit(Key{.name = "ramp",
            .what =
                "The load grows linearly from nothing in this time, from the start or from that of the stage "
                "that adds it.",
            .unit = "s",
            .bounds = positive,
            .default_text = "none"},
        r.ramp);
}

template <class Visit>
void describe(WaterRecord& r, Visit&& visit) {
  visit(Key{.name = "table",
            .what =
                "Points of the water table, x ascending; level beyond its ends. Faces below it bear the unit "
                "weight of water times their depth below it.",
            .unit = "m",
            .default_text = "required in `[water]`"},
        r.table);
  visit(Key{.name = "density",
            .what = "Of water.",
            .unit = "kg/m3",
            .bounds = positive,
            .default_text = "`1000.0`"},
        r.density);
  visit(Key{.name = "joints",
            .what = "Whether faces that touch another block at the start bear it too.",
            .default_text = "`true`"},
        r.joints);
  visit(Key{.name = "joint_table",
            .what = "The table of those faces: the head in joints, such as uplift below a dam.",
            .unit = "m",
            .default_text = "`table`"},
        r.joint_table);
}

template <class Visit>
void describe(QuietRecord& r, Visit&& visit) {
  visit(Key{.name = "on", .what = "All edges that lie on this line.", .unit = "m", .required = true}, r.on);
  visit(Key{.name = "incoming",
            .what = "Velocity in time of a wave that comes in, [[t, vx, vy], ...] or a file.",
            .unit = "m/s",
            .default_text = "none"},
        r.incoming);
}

template <class Visit>
void describe(QuakeRecord& r, Visit&& visit) {
  visit(Key{.name = "acceleration",
            .what = "Of the ground in time, [[t, ax, ay], ...] or a file; linear between entries, 0 outside. "
                    "Blocks move relative to the ground.",
            .unit = "m/s2",
            .required = true},
        r.acceleration);
  visit(Key{.name = "scale", .what = "Times all accelerations."}, r.scale);
}

template <class Visit>
void describe(BoltRecord& r, Visit&& visit) {
  RockBolt& b = r.bolt;
  visit(Key{.name = "name", .what = "What results and stages call it; unique.", .required = true}, r.name);
  visit(Key{.name = "points",
            .what = "Its two ends, where they are at the start of the run.",
            .unit = "m",
            .required = true},
        r.points);
  visit(Key{.name = "type", .what = "Fixed at both ends, or bonded to every block that it passes."}, b.kind);
  visit(Key{.name = "area", .what = "Of its section.", .unit = "m2", .bounds = positive, .required = true},
        b.area);
  visit(Key{.name = "young",
            .what = "Young's modulus of the bar.",
            .unit = "Pa",
            .bounds = positive,
            .required = true},
        b.young);
  visit(Key{.name = "yield_force",
            .what = "The largest axial force of one bolt. In compression anchored ones buckle first.",
            .unit = "N",
            .bounds = positive,
            .default_text = "none: it stays elastic"},
        b.yield_force);
  visit(Key{.name = "rupture_strain",
            .what = "Strain of the bar, elastic and plastic, beyond which it tears.",
            .bounds = positive,
            .default_text = "none: it does not tear"},
        b.rupture_strain);
  visit(Key{.name = "pretension",
            .what = "Axial force of one bolt when it is installed.",
            .unit = "N",
            .bounds = not_negative},
        b.pretension);
  visit(
      Key{.name = "spacing",
          .what = "From one such bolt to the next along the thickness: forces of one bolt are divided by it.",
          .unit = "m",
          .bounds = positive},
      b.spacing);
  visit(Key{.name = "bond_stiffness",
            .what = "grouted: force on the bar per length and slip.",
            .unit = "N/m2",
            .bounds = positive,
            .default_text = "required by \"grouted\""},
        r.bond_stiffness);
  visit(Key{.name = "bond_strength",
            .what = "grouted: the largest force on the bar per length.",
            .unit = "N/m",
            .bounds = positive,
            .default_text = "none: the bond stays elastic"},
        b.bond_strength);
}

template <class Visit>
void describe(MonitorRecord& r, Visit&& visit) {
  visit(Key{.name = "name", .what = "What results call it; unique.", .required = true}, r.name);
  visit(Key{.name = "block", .what = "The block, or those a selector finds.", .required = true}, r.block);
  visit(Key{.name = "at",
            .what = "A point of the block at the start, or the centroid of its outline.",
            .unit = "m",
            .default_text = "this or `vertex` is required"},
        r.at);
  visit(Key{.name = "vertex", .what = "A vertex of the block.", .default_text = "this or `at` is required"},
        r.vertex);
}

template <class Visit>
void describe(StageRecord& r, Visit&& visit) {
  visit(Key{.name = "name", .what = "Unique.", .default_text = "none"}, r.name);
  visit(in_stage(analysis_keys::mode), r.mode);
  visit(Key{.name = "steps",
            .what = "Number of steps of the length `time_step`.",
            .bounds = at_least_one,
            .required = true},
        r.steps);
  visit(in_stage(analysis_keys::time_step), r.time_step);
  visit(in_stage(analysis_keys::max_displacement_ratio), r.max_displacement_ratio);
  visit(in_stage(analysis_keys::gravity), r.gravity);
  visit(in_stage(analysis_keys::scheme), r.scheme);
  visit(in_stage(analysis_keys::beta), r.beta);
  visit(in_stage(analysis_keys::gamma), r.gamma);
  visit(in_stage(analysis_keys::damping), r.damping);
  visit(in_stage(analysis_keys::cutting_factor), r.cutting_factor);
  for (const char* name : {"preset", "plane", "block_model", "mesh", "kinematics", "gradient_correction"})
    visit(Key{.name = name, .what = ""}, OfTheWholeRun{});
  visit(Key{.name = "joints",
            .what = "What is different of joints while the stage lasts; JOINT is a name, or an index where "
                    "there is none."},
        r.joints);
  visit(Key{.name = "reset_displacements",
            .what = "Displacements are counted anew from the end of the stage; stresses stay."},
        r.reset_displacements);
  visit(Key{.name = "remove", .what = "Blocks taken out at the start of the stage."}, r.remove);
  visit(Key{.name = "relax",
            .what = "Steps in which the contact forces of the blocks taken out decrease linearly to nothing.",
            .bounds = at_least_one,
            .default_text = "none: they are gone at once"},
        r.relax);
  visit(Key{.name = "add",
            .what = "Bolts, loads and blocks that come in at the start of the stage, absent before."},
        r.add);
  visit(Key{.name = "until",
            .what =
                "Ends the stage before its steps are made: when forces are in balance, the kinetic energy is "
                "at most `kinetic` times the largest energy exchanged, and every block moves by at most "
                "`displacement` times its size in a second.",
            .bounds = positive},
        r.until);
  visit(Key{.name = "water",
            .what = "What is different of `[water]` while the stage lasts.",
            .default_text = "as in `[water]`"},
        r.water);
}

template <class Visit>
void describe(Skips& s, Visit&& visit) {
  visit(
      Key{.name = "friction_rows", .what = "Tangential terms of contacts with neither friction nor a bond."},
      s.friction_rows);
  visit(Key{.name = "fixed_blocks", .what = "Matrices of blocks that are wholly held where they are."},
        s.fixed_blocks);
  visit(Key{.name = "unchanged_factor",
            .what = "Factorizing a matrix once more that is still the one last factorized."},
        s.unchanged_factor);
  visit(Key{.name = "congruent", .what = "Reference matrices of a block that is congruent to another."},
        s.congruent);
  visit(Key{.name = "output", .what = "Stresses and pictures that are not requested."}, s.output);
  visit(
      Key{.name = "cg", .what = "Factorizing where inertia dominates: sweeps over the contacts do without."},
      s.cg);
  visit(Key{.name = "islands", .what = "Solving blocks together that do not touch."}, s.islands);
  visit(Key{.name = "sleep", .what = "Islands at rest, until something reaches them."}, s.sleep);
  visit(Key{.name = "skin", .what = "Looking for pairs of blocks anew before they moved beyond a margin."},
        s.skin);
}

template <class Visit>
void describe(SolverRecord& r, Visit&& visit) {
  visit(Key{.name = "skip", .what = "What is left out where the scene does not need it."}, r.skip);
}

template <class Visit>
void describe(OutputRecord& r, Visit&& visit) {
  OutputOptions& o = r.options;
  visit(Key{.name = "every",
            .what = "A frame every k steps, the start and the last state always; 0: only the last.",
            .bounds = not_negative},
        o.every);
  visit(Key{.name = "fields", .what = "The fields of frames; others are not computed."}, o.fields);
  visit(
      Key{.name = "refine",
          .what = "Subdivisions for drawing the stress inside a block: 0 draws it as one polygon, r >= 1 as "
                  "triangles, r x r of them in each triangle between an edge and the centroid.",
          .bounds = {.low = 0, .high = 10}},
      o.refine);
  visit(Key{.name = "checkpoint_every",
            .what = "A checkpoint every k steps; at the end and on interruption always, 0: only then.",
            .bounds = not_negative},
        o.checkpoint_every);
}

/// The top of a file: its own keys; visit.table(Key, record) for [table]; visit.tables(Key, records) for
/// [[table]].
template <class Visit>
void describe(Document& d, Visit&& visit) {
  visit(Key{.name = "format", .what = "Version of the scene format.", .bounds = {.low = 1, .high = 1}},
        d.format);
  visit(Key{.name = "title", .what = "One line about the scene."}, d.title);
  visit(Key{.name = "blocks",
            .what = "More blocks, from the polygons of a geometry file (.geojson, .json, .wkt, .dxf, "
                    "Shi's .geo, or cells of a mesh, .msh and .vtu); relative to the scene file.",
            .default_text = "none"},
        d.geometry_file);
  visit(Key{.name = "snap",
            .what = "For rounded coordinates: vertices of blocks nearer to each other become one, and those "
                    "as near "
                    "to an edge of another block move onto it.",
            .unit = "m",
            .bounds = positive,
            .default_text = "none"},
        d.snap);
  visit(
      Key{.name = "initial_stress",
          .what = "Of all blocks that state no `stress`, at their centroids: `stress` at the height `level`, "
                  "and its change per metre upwards.",
          .default_text = "none"},
      d.initial_stress);
  visit(Key{.name = "parameters", .what = "Numbers called \"$name\" wherever a number stands."},
        d.parameters);
  visit.table(Key{.name = "analysis", .what = "What is computed and how.", .required = true}, d.analysis);
  visit.table(Key{.name = "contact", .what = "How contacts are enforced."}, d.contact);
  visit.tables(Key{.name = "material", .what = "What blocks are made of.", .required = true}, d.materials);
  visit.tables(
      Key{.name = "joint",
          .what = "Mohr-Coulomb laws of contacts; without any, one without friction, cohesion and tension."},
      d.joints);
  visit.table(Key{.name = "domain", .what = "Blocks cut by joints."}, d.domain);
  visit.tables(Key{.name = "block", .what = "The blocks.", .required = !d.geometry_file && !d.domain},
               d.blocks);
  visit.tables(Key{.name = "support", .what = "Vertices held or moved; more general than `fixed`."},
               d.supports);
  visit.tables(Key{.name = "load", .what = "Forces."}, d.loads);
  visit.table(Key{.name = "water", .what = "Pressure of water at rest on the faces of blocks."}, d.water);
  visit.tables(Key{.name = "quiet_boundary", .what = "Edges that let waves out, and others in."},
               d.quiet_boundaries);
  visit.tables(Key{.name = "quake", .what = "Shaking of the ground."}, d.quakes);
  visit.tables(Key{.name = "bolt", .what = "Steel bars that hold blocks together; method \"staged\" alone."},
               d.bolts);
  visit.tables(Key{.name = "monitor", .what = "Points whose motion is written at every step."}, d.monitors);
  visit.tables(Key{.name = "stage", .what = "Parts of a run with other options, one after the other."},
               d.stages);
  visit.table(Key{.name = "solver", .what = "What the solver may skip."}, d.solver);
  visit.table(Key{.name = "output", .what = "What is written while running."}, d.output);
}

}  // namespace ddacontact::scene_format
