#include "safety.hpp"

#include "call_error.hpp"
#include "exit_status.hpp"
#include "interruption.hpp"
#include "memory.hpp"
#include "messages.hpp"
#include "named_files.hpp"
#include "option_values.hpp"

#include <fmt/format.h>
#include <ddacontact/output/older_results.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/study/safety_files.hpp>
#include <ddacontact/study/strength_reduction.hpp>
#include <ddacontact/study/trials_ahead.hpp>
#include <polyfem/assembly/blas.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>

namespace dda {

using namespace ddacontact;

namespace {

double factor_of(std::string_view text, const std::string& range) {
  double factor = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), factor);
  if (status != std::errc() || end != text.data() + text.size() || !(factor > 0) || !std::isfinite(factor))
    throw CallError(fmt::format("--range \"{}\" is no range (write A:B, 0 < A < B)", range));
  return factor;
}

std::optional<FactorRange> range_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view all = text;
  const FactorRange range{factor_of(all.substr(0, colon), text),
                          factor_of(all.substr(std::min(colon + 1, text.size())), text)};
  if (range.low >= range.high)
    throw CallError(fmt::format("--range \"{}\" is no range (write A:B, 0 < A < B)", text));
  return range;
}

/// By name, or by index where a joint has none.
std::string name_of(const Scene& scene, int joint) {
  const std::string& name = scene.joints[joint].name;
  return name.empty() ? std::to_string(joint) : name;
}

std::vector<int> joints_called(const std::vector<std::string>& wanted, const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) names.push_back(name_of(scene, static_cast<int>(j)));
  std::vector<int> joints;
  for (const std::string& name : wanted.empty() ? names : wanted) {
    const auto known = std::ranges::find(names, name);
    if (known == names.end())
      throw CallError(fmt::format("unknown joint \"{}\" of --joints ({})", name,
                                  choice_among(name, {names.begin(), names.end()})));
    joints.push_back(static_cast<int>(known - names.begin()));
  }
  return joints;
}

/// A part of the blocks so small is worth a look before its factor is taken for that of all.
constexpr double small_share = 0.05;

/// A joint that weakens where it slips does so contact by contact, not all at once.
void warn_of_brittle_joints(const Scene& scene, const std::vector<int>& joints, const std::string& file) {
  for (const int j : joints)
    if (const Joint& joint = scene.stages.back().joints[j];
        joint.residual_friction_angle &&
        (bonds_of(scene, {j}) == "brittle" || *joint.residual_friction_angle < joint.friction_angle))
      say("{}: warning: joint \"{}\" has a residual friction angle and loses its peak strength where it "
          "slips, and so fails from its ends: limit equilibrium, where all of the peak strength acts at "
          "once, gives a larger factor\n",
          file, name_of(scene, j));
}

/// Blocks that vibrate slip below their limit, at the moments at which they press least.
void warn_of_vibrations(const Scene& scene, const std::string& file) {
  const AnalysisOptions& last = scene.stages.back().analysis;
  const bool keeps_them = last.scheme == Scheme::midpoint || last.scheme == Scheme::central_difference ||
                          (last.scheme == Scheme::newmark && last.gamma == 0.5);
  if (last.mode == Mode::dynamic && keeps_them && last.damping.stiffness == 0)
    say("{}: warning: the scheme of the last stage keeps vibrations, under which blocks slip below "
        "their limit: the factor may be much too low (scheme = \"decaying\", or damping = {{ stiffness "
        "= 1e-3 }})\n",
        file);
}

/// Glue bears whatever comes, so that a strength that is reduced does not count.
void warn_of_glue(const Scene& scene, const std::vector<int>& joints, const std::string& file) {
  for (const int j : joints)
    if (scene.stages.back().joints[j].glued)
      say("{}: warning: joint \"{}\" is glued in the last stage, where its strength does not count "
          "(glue the stage before it)\n",
          file, name_of(scene, j));
}

void tell(const StrengthTrial& trial, const Scene& scene) {
  say("F = {:.5g}: {} after {} steps: {}{}\n", trial.factor, word_of(trial.verdict), trial.steps,
      trial.reason,
      trial.first_block < 0 ? ""
                            : fmt::format("; \"{}\" went furthest", scene.block_name(trial.first_block)));
}

/// What moves first, and how much that is.
std::string moved_text(const StrengthTrial& trial, const Scene& scene) {
  if (trial.first_block < 0) return "";
  const MovedPart part = moved_part(scene, trial);
  return fmt::format("\"{}\" moves furthest; {} of {} blocks move, {:.1f} % of their area",
                     scene.block_name(trial.first_block), part.blocks, part.of_blocks, 100 * part.area_share);
}

/// A line, or nothing.
std::string note_of_small_part(const SafetyFiles& files, const Scene& scene) {
  const StrengthTrial* first = files.first_to_move();
  if (!first || first->first_block < 0 || moved_part(scene, *first).area_share >= small_share) return "";
  return "note: this is the factor of a small part, see safety_moved.svg; that of the rest is larger (fix or "
         "remove these blocks to find it)\n";
}

/// A factor that only sharp corners give.
void warn_of_sharp_corners(const RoundedTrial& rounded, const std::string& file) {
  const std::string trial =
      fmt::format("{}: warning: with corners rounded by {:.2g} of a block's size ", file, rounded.rounding);
  const long broken = rounded.trial.broken_bonds;
  if (rounded.trial.verdict == Verdict::moves && broken > 0)
    say("{}blocks move at F = {:.4g} already, after {} bonds broke: rounded corners break them too "
        "early, or sharp ones interlock at steps that rock would not have\n",
        trial, rounded.trial.factor, broken);
  else if (rounded.trial.verdict == Verdict::moves)
    say("{}blocks move at F = {:.4g} already: sharp corners interlock at steps that rock would not "
        "have (contact = {{ corner_rounding = {:.2g} }})\n",
        trial, rounded.trial.factor, rounded.rounding);
  if (rounded.trial.verdict == Verdict::stopped)
    say("{}nothing is known: {} (sharp corners may interlock at steps that rock would not have)\n", trial,
        rounded.trial.reason);
}

/// A factor that only blocks that swell have.
void warn_of_swelling(const StrengthTrial& trial, const std::string& file) {
  if (trial.verdict != Verdict::moves) return;
  say("{}: warning: with poisson = 0 blocks move at F = {:.4g} already: blocks without a mesh that swell "
      "sideways may be held by friction on faces beside them (compare block_model = \"mesh\")\n",
      file, trial.factor);
}

/// What a search that ended without an answer knows.
std::string known_of(const FactorBracket& bracket) {
  return (bracket.low > 0 ? fmt::format("; it rests at {:.5g}", bracket.low) : "") +
         (std::isfinite(bracket.high) ? fmt::format("; it moves at {:.5g}", bracket.high) : "");
}

/// That, and how to go on.
std::string without_answer(const FactorBracket& bracket, const StrengthTrial& last) {
  return fmt::format(
      "no factor of safety: the trial at F = {:.5g} stopped without a verdict: {}{} (try a smaller "
      "analysis.time_step, or --range beside this factor; all trials are in safety.csv)",
      last.factor, last.reason, known_of(bracket));
}

/// Significant ones that tell the ends of a bracket apart which is as narrow as the tolerance.
int digits_for(double tolerance) {
  return std::max(4, 2 - static_cast<int>(std::ceil(std::log10(tolerance) - 1e-9)));
}

/// In a line, for stdout.
std::string answer(const FactorBracket& bracket, double tolerance, const SafetyFiles& files,
                   const Scene& scene) {
  const StrengthTrial* first = files.first_to_move();
  const std::string moved = first ? moved_text(*first, scene) : "";
  if (bracket.low == 0) return fmt::format("moves at every factor from {:.5g} on; {}", bracket.high, moved);
  if (!bracket.closed()) return fmt::format("rests at every factor up to {:.5g}", bracket.low);
  const int digits = digits_for(tolerance);
  return fmt::format("factor of safety {:.{}g} .. {:.{}g}; {}", bracket.low, digits, bracket.high, digits,
                     moved);
}

void keep_older(const SafetyArguments& arguments) {
  DirectoryLock::expect_free(arguments.directory);
  if (arguments.force) return;
  if (const auto kept = keep_older_results(arguments.directory); kept && !arguments.quiet)
    say("{}: note: older results are in {} now\n", arguments.scene, kept->string());
}

/// The settled scene. Where it does not settle the results say so before this throws SettlingStopped: older
/// ones are not left for those of this scene.
StrengthReduction settled(const SafetyArguments& arguments, const Scene& scene,
                          const std::vector<int>& joints) {
  try {
    return StrengthReduction(scene, joints);
  } catch (const SettlingStopped& stopped) {
    keep_older(arguments);
    SafetyFiles(arguments.directory, scene, joints)
        .finish({.stopped = true}, {}, arguments.tolerance, stopped.what(), 0);
    throw;
  }
}

int search(const SafetyArguments& arguments, const Scene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  const std::optional<FactorRange> range = range_of(arguments.range);
  const std::vector<int> joints = joints_called(arguments.joints, scene);
  if (!arguments.force && holds_results(arguments.directory))
    expect_none_in(arguments.directory, files_of_scene(arguments.scene, arguments.settings));
  polyfem::pin_blas_to_one_thread();
  const StrengthReduction reduction = settled(arguments, scene, joints);
  for (const std::string& note : reduction.notes()) say("{}: note: {}\n", arguments.scene, note);
  if (!reduction.unsettled().empty())
    say("{}: warning: {} when the trials start: more 'steps' before the last stage\n", arguments.scene,
        reduction.unsettled());
  warn_of_brittle_joints(reduction.scene(), joints, arguments.scene);
  warn_of_vibrations(reduction.scene(), arguments.scene);
  warn_of_glue(reduction.scene(), joints, arguments.scene);
  keep_older(arguments);
  SafetyFiles files(arguments.directory, reduction.scene(), joints);
  const DirectoryLock lock(arguments.directory);
  note_interruptions();
  const int at_once =
      arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
  std::map<double, std::string> pulled_bonds;  // of trials, by their factors
  const FactorBracket bracket = bracket_factor_ahead(
      [&](double factor, const std::function<bool()>& given_up) {
        return reduction.try_factor(factor, {}, [&] { return interruption() != 0 || given_up(); });
      },
      at_once, range, arguments.tolerance,
      [&](const StrengthTrial& trial) {
        if (interruption()) return;
        files.add(trial);
        pulled_bonds[trial.factor] = trial.pulled_bonds;
        if (!arguments.quiet) tell(trial, scene);
      });
  if (interruption()) {
    print_error(
        fmt::format("interrupted by signal {}: no factor of safety{} (trials so far are in {}/safety.csv)",
                    interruption(), known_of(bracket), arguments.directory));
    return interrupted + interruption();
  }
  if (const std::string& pulled = pulled_bonds[bracket.low]; !pulled.empty())
    say("{}: warning: at F = {:.4g} {}: limit equilibrium gives a smaller factor (compare one without "
        "'tensile_strength')\n",
        arguments.scene, bracket.low, pulled);
  end_at_interruptions();  // there is no result without the trials that follow
  VariantTrials variants;
  if (!bracket.stopped && bracket.low > 0)
    variants = {try_with_rounded_corners(scene, joints, bracket.low),
                try_without_swelling(scene, joints, bracket.low)};
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  files.finish(bracket, variants, arguments.tolerance, reduction.unsettled(), wall.count());
  if (bracket.stopped) {
    print_error(without_answer(bracket, files.last()));
    return analysis_stopped;
  }
  if (variants.rounded) warn_of_sharp_corners(*variants.rounded, arguments.scene);
  if (variants.without_swelling) warn_of_swelling(*variants.without_swelling, arguments.scene);
  fmt::print("{}\n", answer(bracket, arguments.tolerance, files, scene));
  if (arguments.quiet) return done;
  fmt::print("{}", note_of_small_part(files, scene));
  fmt::print(
      "the factor divides friction and cohesion of joints; loads, weights{} and water stay as stated\n",
      scene.bolts.empty() ? "" : ", bolts");
  if (bonds_of(reduction.scene(), joints) == "ductile")
    fmt::print("cohesion and tensile strength outlast slip\n");
  fmt::print("results in {}\n", arguments.directory);
  return done;
}

}  // namespace

void add_safety(CLI::App& app, SafetyArguments& arguments) {
  CLI::App* safety = app.add_subcommand(
      "safety",
      "Factor of safety by strength reduction: joints are weakened until blocks move in the last stage");
  safety->add_option("SCENE", arguments.scene, "Scene file (TOML)")->required();
  safety
      ->add_option("-o,--output", arguments.directory,
                   "Result directory: safety.csv, safety.json, safety.svg, safety_moved.svg")
      ->required()
      ->type_name("DIR");
  safety->add_option("--joints", arguments.joints, "The joints to weaken; left out: all")
      ->delimiter(',')
      ->type_name("NAME,...");
  safety
      ->add_option("--range", arguments.range,
                   "Search between these factors; left out: from 1 on, up or down")
      ->type_name("A:B");
  expect_number(
      safety->add_option("--tolerance", arguments.tolerance, "Width of the bracket over the factor"), 1e-6, 1)
      ->capture_default_str();
  safety->add_option("--set", arguments.settings, "Replace a value of the scene; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("PATH=VALUE");
  expect_whole_number(
      safety->add_option("--jobs", arguments.jobs,
                         "Trials at a time; left out: as many as processors; the answer is the same"),
      1, 1024);
  safety->add_flag("--force", arguments.force, "Overwrite older results instead of renaming them");
  safety->add_flag("--quiet", arguments.quiet, "Print one line, the factor, and problems");
}

int safety(const SafetyArguments& arguments) {
  const SceneReading reading = read_scene(arguments.scene, arguments.settings);
  if (const int status = report(reading); !reading.scene) return status;
  if (const auto problem = memory_problem(*reading.scene)) {
    say("{}:1:1: error: {}\n", arguments.scene, *problem);
    return wrong_input;
  }
  try {
    return search(arguments, *reading.scene);
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const OutputError& error) {
    print_error(error.what());
    return file_error;
  } catch (const SettlingStopped& error) {
    print_error(error.what());
    return analysis_stopped;
  } catch (const Error& error) {
    say("{}:1:1: error: {}\n", arguments.scene, error.what());
    return wrong_input;
  }
}

}  // namespace dda
