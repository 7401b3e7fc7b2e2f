#include <ddacontact/scene/scheme_check.hpp>

#include <ddacontact/scene/text.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact::scene_format {

namespace {

/// From here on what alternates is damped faster than turning feeds it, see doc/decisions.md.
constexpr double least_gamma = 0.6;
/// Times that a wave runs through a block in a step: at a hundred steps a turn 9 are stable for a hundred
/// turns, 16 multiply the kinetic energy by 6e4 in twenty.
constexpr double most_crossings = 10;

/// Stiffness-proportional damping may make critical steps so many times shorter.
constexpr double most_shortened = 10;
/// The stiffest vibration of a square block, over the time in which a wave runs through it.
const double frequency_of_square = 2 * std::sqrt(3.);

/// How many sizes of the block a pressure wave runs in a second, 1/s.
double crossings_per_second(const Material& material, double area, Plane plane) {
  const double stiffness = polyfem::elasticity_matrix(material.young, material.poisson, plane)(0, 0);
  return std::sqrt(stiffness / material.density / area);
}

/// The block that a wave crosses most often in a step; -1: none may turn.
struct Stiffest {
  int block = -1;
  double crossings = 0;  ///< per second
};
Stiffest stiffest_block(const Scene& scene, const std::vector<bool>& may_turn) {
  Stiffest stiffest;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const BlockDescription& block = scene.blocks[b];
    const double area = std::abs(polyfem::signed_area(block.vertices));
    if (!may_turn[b] || !(area > 0)) continue;
    const double crossings =
        crossings_per_second(scene.materials[block.material], area, scene.analysis.plane);
    if (crossings > stiffest.crossings) stiffest = {static_cast<int>(b), crossings};
  }
  return stiffest;
}

/// Blocks that a scheme without damping lifts hop, and what they slip above the joint lifts them no more.
void check_dilation(const Document& document, const Scene& scene, ProblemList& problems) {
  const auto lets_hop = [](const AnalysisOptions& analysis) {
    return analysis.mode == Mode::dynamic && analysis.scheme != Scheme::decaying &&
           analysis.scheme != Scheme::backward_euler;
  };
  if (scene.stages.empty() ? !lets_hop(scene.analysis)
                           : std::ranges::none_of(scene.stages, lets_hop, &StageDescription::analysis))
    return;
  for (std::size_t j = 0; j < document.joints.size(); ++j)
    if (scene.joints[j].dilation_angle)
      problems.error(document.joints[j].locations.of("dilation_angle"),
                     "'dilation_angle' with dynamic steps of a scheme that lets lifted blocks hop",
                     "write scheme = \"decaying\" or \"backward_euler\", or mode = \"static\"");
}

}  // namespace

void check_scheme(const Document& document, const Scene& scene, const NameTable& blocks,
                  const std::vector<bool>& may_turn, ProblemList& problems) {
  check_dilation(document, scene, problems);
  const Stiffest stiffest = stiffest_block(scene, may_turn);
  const auto check = [&](const AnalysisOptions& analysis, const KeyLocations& own) {
    const double crossings = stiffest.crossings * analysis.time_step;
    if (analysis.mode != Mode::dynamic || analysis.scheme != Scheme::newmark ||
        analysis.gamma >= least_gamma || analysis.kinematics != Kinematics::corotational ||
        crossings <= most_crossings)
      return false;
    const SourceLocation& location = own.written("gamma")    ? own.of("gamma")
                                     : own.written("scheme") ? own.of("scheme")
                                                             : document.analysis.locations.of("scheme");
    problems.warning(location,
                     "scheme \"newmark\" with gamma = '" + short_number(analysis.gamma) +
                         "' is not stable when stiff blocks turn: in a step of " +
                         short_number(analysis.time_step) + " s a wave runs through " +
                         blocks.title(stiffest.block) + " " + rounded(crossings) + " times",
                     "write gamma = 0.6, or scheme = \"decaying\" or \"midpoint\"");
    return true;
  };
  // By damping the explicit scheme's critical step becomes 2/w (sqrt(1 + z^2) - z), see critical_step.
  const auto check_explicit = [&](const AnalysisOptions& analysis, const KeyLocations& own) {
    const double w = frequency_of_square * stiffest.crossings, z = analysis.damping.stiffness * w / 2,
                 shortened = std::hypot(1, z) + z;
    if (analysis.mode != Mode::dynamic || analysis.scheme != Scheme::central_difference ||
        shortened <= most_shortened)
      return false;
    const SourceLocation& location =
        own.written("damping") ? own.of("damping") : document.analysis.locations.of("damping");
    problems.error(
        location,
        "scheme \"explicit\" with a damping stiffness of '" + short_number(analysis.damping.stiffness) +
            "' s is stable in steps below about " + rounded(2 / w / shortened) +
            " s alone: without it below " + rounded(2 / w) + " s, by " + blocks.title(stiffest.block),
        "write a stiffness of at most " + rounded((most_shortened - 1) / w) + " s, or scheme = \"decaying\"");
    return true;
  };
  // Pressures that follow blocks are those of the start of the step there.
  const auto check_water = [&](const AnalysisOptions& analysis, const KeyLocations& own, const Water& water) {
    if (analysis.mode != Mode::dynamic || analysis.scheme != Scheme::dda || water.table.cols() == 0)
      return false;
    problems.warning(own.written("scheme") ? own.of("scheme") : document.analysis.locations.of("scheme"),
                     "blocks that float would gain energy by scheme \"dda\", whose forces are those of the "
                     "start of a step",
                     "write scheme = \"decaying\" or \"midpoint\"");
    return true;
  };
  const auto check_all = [&](const AnalysisOptions& analysis, const KeyLocations& own, const Water& water) {
    return check(analysis, own) || check_explicit(analysis, own) || check_water(analysis, own, water);
  };
  if (scene.stages.empty()) check_all(scene.analysis, document.analysis.locations, scene.water);
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const StageDescription& stage = scene.stages[s];
    if (check_all(stage.analysis, document.stages[s].locations, stage.water)) return;
  }
}

}  // namespace ddacontact::scene_format
