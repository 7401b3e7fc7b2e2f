#include <ddacontact/output/run_verdict.hpp>

#include <ddacontact/output/buckling.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace ddacontact {

namespace {

std::string figure(double value, int digits = 2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// What is out of balance becomes less by more than this in a substep: it settles.
constexpr double settling = 0.01;
/// A block that has moved further than this part of its size is not where a static analysis began.
constexpr double another_shape = 0.1;

std::string quoted_block(const Stepper& stepper, int block) {
  return "block \"" + stepper.blocks().names[block] + '"';
}

std::string stage_title(const Stepper& stepper, int stage) {
  const std::string& name = stepper.stages()[stage].name;
  return name.empty() ? "stage " + std::to_string(stage) : "stage \"" + name + '"';
}

/// "block "a" out of balance by 0.3 of the largest force on it".
std::string imbalance(const Stepper& stepper, const Equilibrium& e) {
  return quoted_block(stepper, e.unbalanced_block) + " is out of balance by " + figure(e.unbalanced) +
         " of the largest force on it";
}

std::string motion(const Stepper& stepper, const Equilibrium& e) {
  return quoted_block(stepper, e.fastest_block) + " moves fastest, " + figure(e.fastest) + " m/s";
}

void add_unmet_until(const Stepper& stepper, const StageEnd& end, std::vector<std::string>& warnings) {
  const Stage& stage = stepper.stages()[end.stage];
  if (!stage.until || end.came_to_rest || end.steps < stage.analysis.steps) return;
  const Equilibrium& e = end.equilibrium;
  std::string text = stage_title(stepper, end.stage) + " made all its " + std::to_string(end.steps) +
                     " steps and its 'until' never came true";
  if (const double change = last_change(stepper.blocks()); change > end.time)
    text += ": a load, a support or the ground changes until t = " + figure(change) + " s";
  if (!e.in_balance()) text += ": " + imbalance(stepper, e);
  if (stage.until->kinetic && e.kinetic > *stage.until->kinetic * end.exchanged)
    text += ": the kinetic energy is " + figure(e.kinetic / end.exchanged) + " of the largest exchanged";
  if (stage.until->displacement && e.relative_speed > *stage.until->displacement)
    text += ": a block moves by " + figure(e.relative_speed) + " of its size a second";
  if (e.fastest_block >= 0) text += "; " + motion(stepper, e);
  warnings.push_back(text + " (more 'steps', more damping, or larger values of 'until')");
}

/// Whether what stands still at the end of static steps has gone there from another shape. Where blocks moved
/// with velocities before, or supports move, they are not expected to stay.
void add_other_shape(const Stepper& stepper, std::vector<std::string>& warnings) {
  const BlockSystem& blocks = stepper.blocks();
  for (int s = 0; s <= stepper.stage(); ++s)
    if (stepper.stages()[s].analysis.mode != Mode::statics) return;
  const auto moves = [](const auto& held) { return held.motion.kind != TimeFunction::Kind::constant; };
  if (std::ranges::any_of(blocks.prescribed_dofs(), moves) ||
      std::ranges::any_of(blocks.fixed_vertices, moves))
    return;
  const FurthestMove furthest = furthest_move(stepper);
  if (furthest.of_size > another_shape)
    warnings.push_back("the static steps found an equilibrium, but of another shape: " +
                       quoted_block(stepper, furthest.block) + " has moved by " + figure(furthest.of_size) +
                       " of its size (the scene as it is drawn has no equilibrium, or only one far from it)");
}

bool are_supports_moving(const BlockSystem& blocks, double time) {
  const auto moves = [&](const auto& held) {
    const TimeFunction& motion = held.motion;
    return motion.kind == TimeFunction::Kind::rate ? !motion.value.isZero(0)
                                                   : motion.last_change(blocks.end_time) >= time;
  };
  return std::ranges::any_of(blocks.prescribed_dofs(), moves) ||
         std::ranges::any_of(blocks.fixed_vertices, moves);
}

/// Loads that the run ends before.
void add_changes_to_come(const Stepper& stepper, const StageEnd& last, std::vector<std::string>& warnings) {
  const double change = last_change(stepper.blocks()), round_off = 1e-9 * change;
  const bool goes_on = !last.came_to_rest && last.steps < stepper.stages()[last.stage].analysis.steps;
  if (goes_on || last.time >= change - round_off) return;
  const auto came_early = [](const StageEnd& end) { return end.came_to_rest; };
  const bool early = last.came_to_rest || std::ranges::any_of(stepper.stage_ends(), came_early);
  warnings.push_back(
      "the run ends at t = " + figure(last.time, 6) + " s, but loads, supports or shaking change until t = " +
      figure(change, 6) + " s: what they do then is not in the results (" +
      (early ? "'until' ended a stage early, and time goes on from there: leave it out, or give "
               "the stages after it more 'steps')"
             : "more 'steps')"));
}

/// Static steps of a stage that is over: the next one began with what they left out of balance.
void add_unbalanced_stage(const Stepper& stepper, const StageEnd& end, std::vector<std::string>& warnings) {
  const Stage& stage = stepper.stages()[end.stage];
  if (stage.analysis.mode != Mode::statics || end.equilibrium.in_balance() || stage.until ||
      are_supports_moving(stepper.blocks(), end.time))
    return;
  warnings.push_back(stage_title(stepper, end.stage) + " ended before it was in equilibrium: " +
                     imbalance(stepper, end.equilibrium) + " (more 'steps' for it)");
}

/// What two blocks press each other with at the end, over all their contacts.
struct Pressing {
  int n_contacts = 0;
  double force = 0, strength = 0;  ///< N per m; the strength is that in compression
};

std::map<Pair, Pressing> find_pressing(const Stepper& stepper) {
  std::map<Pair, Pressing> pressing;
  const ContactProperties& properties = stepper.contact_properties();
  for (const ContactRecord& contact : stepper.contacts()) {
    const auto [a, b] = std::minmax(contact.pair.vertex_block, contact.pair.edge_block);
    Pressing& of_pair = pressing[Pair{a, b}];
    of_pair.strength += properties.over_length(contact, &JointStrength::compressive_strength);
    if (contact.normal <= 0) continue;
    ++of_pair.n_contacts;
    of_pair.force += contact.normal;
  }
  return pressing;
}

std::string between(const Stepper& stepper, const Pair& pair) {
  return "between block \"" + stepper.blocks().names[pair[0]] + "\" and block \"" +
         stepper.blocks().names[pair[1]] + '"';
}

/// Joints that bear more than their whole section can.
void add_crushed(const Stepper& stepper, const std::map<Pair, Pressing>& pressing,
                 std::vector<std::string>& warnings) {
  for (const auto& [pair, of_pair] : pressing)
    if (of_pair.strength > 0 && of_pair.force > of_pair.strength)
      warnings.push_back("the joint " + between(stepper, pair) + " bears " +
                         figure(of_pair.force / of_pair.strength) +
                         " of what its 'compressive_strength' allows over its whole length: it is crushed, "
                         "which is not followed (a larger section, or smaller loads)");
}

/// Thrust above this part of Euler's load makes bending a tenth larger, of a pinned strut, and more of
/// others.
constexpr double large_thrust = 0.1;

/// Slender blocks at the end that their model keeps from buckling.
void add_buckling(const Stepper& stepper, const StageEnd& last, std::vector<std::string>& warnings) {
  const bool follows_cells = !step_rule(stepper.stages()[last.stage].analysis, 1, 1).has_half_steps();
  const Buckling nearest = nearest_to_buckling(stepper.blocks(), stepper.state(), follows_cells);
  if (nearest.of_critical > large_thrust)
    warnings.push_back(
        quoted_block(stepper, nearest.block) + " bears a thrust of " + figure(nearest.of_critical) +
        " of Euler's load of a strut of its length, pinned at both ends: its model leaves out how "
        "thrust adds to bending, and buckling (block_model = \"mesh\" with scheme = "
        "\"backward_euler\")");
}

/// Contact patches with too few nodes for a pressure that varies over them.
void add_coarse_patches(const Stepper& stepper, const std::map<Pair, Pressing>& pressing,
                        const std::vector<std::string>& reasons, std::vector<std::string>& warnings) {
  constexpr int least_nodes = 4;
  const auto is_meshed = [&](int b) {
    return stepper.blocks().block(b).n_cells() > 1 && (reasons.empty() || reasons[b].empty());
  };
  int n_coarse = 0;
  double largest = 0;
  Pair worst{};
  for (const auto& [pair, of_pair] : pressing) {
    if (!is_meshed(pair[0]) && !is_meshed(pair[1])) continue;
    if (of_pair.n_contacts == 0 || of_pair.n_contacts >= least_nodes) continue;
    ++n_coarse;
    if (of_pair.force <= largest) continue;
    largest = of_pair.force;
    worst = pair;
  }
  if (n_coarse > 0)
    warnings.push_back("contact patches of meshed blocks with fewer than four nodes: " +
                       std::to_string(n_coarse) + "; the largest force is that " + between(stepper, worst) +
                       ": the largest stresses of these blocks are those of their cells, not of the contact "
                       "(smaller cells there: mesh = { at_contact = ... })");
}

/// Of all substeps: those in which contacts of most blocks change are no single events then.
constexpr double often = 0.1;
/// A first loading changes the contacts of a block a few times, a vibration every few substeps: changes, and
/// their part of the substeps in which the block slid.
constexpr long least_changes = 20;
constexpr double least_unsteady_part = 0.02;
/// Of the largest energy exchanged.
constexpr double large_rise = 0.01, large_push = 0.1;
/// Stiffness-proportional damping of .3 of critical in the first mode of a block, over the time that a wave
/// takes through it: doc/decisions.md.
constexpr double damping_of_transit = 0.2;

/// What its steps met.
void add_seen(const Stepper& stepper, std::vector<std::string>& warnings) {
  const RunWarnings& seen = stepper.warnings();
  const long substeps = stepper.counts().substeps;
  const std::string of_all = " of " + std::to_string(substeps) + " substeps";
  if (seen.far.substeps > 0)
    warnings.push_back("a block in contact moved further than a tenth of its size in " +
                       std::to_string(seen.far.substeps) + of_all + ", first at " +
                       figure(seen.far.first_time) + " s; furthest " + quoted_block(stepper, seen.far.block) +
                       ", by " + figure(seen.far.largest) +
                       " of its size: results may depend on the step (a smaller 'time_step')");
  if (seen.strained.substeps > 0)
    warnings.push_back("strains are large in " + std::to_string(seen.strained.substeps) + of_all +
                       ", first at " + figure(seen.strained.first_time) + " s; most in " +
                       quoted_block(stepper, seen.strained.block) + ", whose edges change by " +
                       figure(100 * seen.strained.largest) +
                       " %: elasticity is linear, for small strains (is 'young' right, with its unit?)");
  if (static_cast<double>(seen.changed.substeps) > often * static_cast<double>(substeps))
    warnings.push_back("contacts of most blocks changed their state in " +
                       std::to_string(seen.changed.substeps) + of_all + ", first at " +
                       figure(seen.changed.first_time) +
                       " s: results may depend on the step (a smaller 'time_step')");
  if (seen.caught.substeps > 0)
    warnings.push_back("a corner caught on a small step in a flush joint in " +
                       std::to_string(seen.caught.substeps) + of_all + ", first at " +
                       figure(seen.caught.first_time) + " s, of " + quoted_block(stepper, seen.caught.block) +
                       ": where blocks rest or stop, compare a run with rounded corners (contact = { "
                       "corner_rounding = 0.003 })");
  const auto worst = std::ranges::max_element(seen.unsteady);
  const auto b = static_cast<int>(worst - seen.unsteady.begin());
  if (worst != seen.unsteady.end() && *worst >= least_changes &&
      static_cast<double>(*worst) >= least_unsteady_part * static_cast<double>(seen.slid[b]))
    warnings.push_back(
        quoted_block(stepper, b) + " vibrates by friction: its contacts changed their state in " +
        std::to_string(*worst) + " of the " + std::to_string(seen.slid[b]) +
        " substeps in which it slid: it does not slide as a rigid block does (damping = { stiffness = " +
        figure(damping_of_transit * transit_time(stepper.blocks().block(b))) +
        " }, or an implicit scheme and a 'time_step' longer than " +
        figure(transit_time(stepper.blocks().block(b))) + " s)");
  const EnergyLedger& energy = stepper.energy();
  const auto amount = [&](double joules) {
    return figure(joules) + " J per m, " + std::to_string(std::lround(100 * joules / energy.exchanged())) +
           " % of the largest energy exchanged, ";
  };
  if (energy.created() > large_rise)
    warnings.push_back(
        "energy rose by " + amount(energy.created() * energy.exchanged()) +
        "above what loads and supports put in (a smaller 'time_step'; \"decaying\" in place of "
        "another scheme; \"newmark\" needs a gamma of 0.6)");
  if (energy.has_exchanged() && energy.pushed_at_once() > large_push * energy.exchanged())
    warnings.push_back("contacts pushed blocks out of each other with " + amount(energy.pushed_at_once()) +
                       "in one step: nothing has put that in (a smaller 'time_step')");
}

}  // namespace

double last_change(const BlockSystem& blocks) {
  double last = blocks.fading.to;
  for (const TimeFunction* function : blocks.time_functions())
    last = std::max(last, function->last_change(blocks.end_time));
  return last;
}

FurthestMove furthest_move(const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  const Points moved = blocks.displacements(stepper.state());
  FurthestMove furthest;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Range& v = blocks.block(b).vertices();
    if (!blocks.is_present(b)) continue;
    const double of_size =
        moved.middleCols(v.first, v.count).colwise().norm().maxCoeff() / blocks.block(b).size();
    if (of_size > furthest.of_size) furthest = {b, of_size};
  }
  return furthest;
}

std::string describe_pulled_bonds(const Stepper& stepper) {
  const ContactProperties& properties = stepper.contact_properties();
  std::map<Pair, int> n_of_pair;
  int n = 0;
  for (const ContactRecord& contact : stepper.contacts()) {
    if (!contact.history.bonded || contact.normal >= 0) continue;
    const JointLaw law = properties.law(contact);
    if (law.glued || std::abs(contact.shear) <= std::max(0.0, law.cohesion + law.friction * contact.normal))
      continue;
    ++n;
    const auto [a, b] = std::minmax(contact.pair.vertex_block, contact.pair.edge_block);
    ++n_of_pair[Pair{a, b}];
  }
  if (n == 0) return "";
  const Pair most = std::ranges::max_element(n_of_pair, {}, [](const auto& of) { return of.second; })->first;
  return std::to_string(n) + (n == 1 ? " bonded contact is" : " bonded contacts are") +
         " pulled and bear more shear than cohesion less tension times tan(phi), most " +
         between(stepper, most) + ": cohesion acts whole until a bond breaks";
}

std::vector<std::string> warnings_of(const Stepper& stepper, const std::vector<std::string>& reasons) {
  std::vector<std::string> warnings;
  for (const StageEnd& end : stepper.stage_ends()) {
    add_unmet_until(stepper, end, warnings);
    add_unbalanced_stage(stepper, end, warnings);
  }
  const StageEnd last = stepper.stage_end();
  add_unmet_until(stepper, last, warnings);
  add_changes_to_come(stepper, last, warnings);
  const Equilibrium& e = last.equilibrium;
  const bool is_static = stepper.stages()[last.stage].analysis.mode == Mode::statics;
  if (is_static && e.in_balance()) add_other_shape(stepper, warnings);
  if (is_static && !e.in_balance()) {
    const bool driven = are_supports_moving(stepper.blocks(), last.time);
    std::string text = "this is no equilibrium: the static steps end with " + std::to_string(e.n_unbalanced) +
                       (e.n_unbalanced == 1 ? " block" : " blocks") + " out of balance; " +
                       imbalance(stepper, e);
    if (e.fastest_block >= 0) text += ", " + motion(stepper, e);
    const double change = e.unbalanced / e.unbalanced_before - 1;
    warnings.push_back(text +
                       (driven ? " (supports still move: end their histories some steps before the run)"
                        : change < -settling
                            ? " (more 'steps': the last one reduced this by " + figure(-100 * change) + " %)"
                            : " (more 'steps'; if this does not decrease, the scene has no equilibrium)"));
  }
  const std::map<Pair, Pressing> pressing = find_pressing(stepper);
  add_crushed(stepper, pressing, warnings);
  add_coarse_patches(stepper, pressing, reasons, warnings);
  add_buckling(stepper, last, warnings);
  if (const std::string pulled = describe_pulled_bonds(stepper); !pulled.empty())
    warnings.push_back(pulled + " (compare a run without 'tensile_strength')");
  add_seen(stepper, warnings);
  return warnings;
}

}  // namespace ddacontact
