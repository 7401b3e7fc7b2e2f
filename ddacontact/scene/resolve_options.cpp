#include <ddacontact/scene/resolve_options.hpp>

#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/mesh_check.hpp>
#include <ddacontact/scene/preset_defaults.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <string_view>

namespace ddacontact::scene_format {

namespace {

/// Keys of [analysis] or, where a stage has them, of that.
class OwnKeys {
 public:
  OwnKeys(const KeyLocations& own, const KeyLocations& of_scene) : own_(own), of_scene_(of_scene) {}

  bool written(std::string_view key) const { return own_.written(key); }
  bool usable(std::string_view key) const {
    return own_.usable(key) && (own_.written(key) || of_scene_.usable(key));
  }
  const SourceLocation& of(std::string_view key) const { return own_.of(key); }

 private:
  const KeyLocations &own_, &of_scene_;
};

void resolve_scheme(const AnalysisRecord& record, const OwnKeys& own, AnalysisOptions& options,
                    ProblemList& problems) {
  const Defaults& preset = defaults_of(options.preset);
  options.kinematics = record.kinematics.value_or(preset.kinematics);
  const bool turning = options.kinematics == Kinematics::corotational;
  options.scheme =
      record.scheme.value_or(needs_corotational(preset.scheme) && !turning ? Scheme::dda : preset.scheme);
  if (!needs_corotational(options.scheme) || turning || !own.written("scheme") || !own.usable("scheme") ||
      !own.usable("kinematics"))
    return;
  problems.error(own.of("scheme"),
                 "'scheme' = " + value_text(options.scheme) + " needs kinematics = \"corotational\"",
                 "write that in [analysis], or scheme = \"dda\", \"newmark\" or \"backward_euler\"");
}

/// Stable at any time step when 2 beta >= gamma >= 1/2; of these, (gamma + 1/2)^2 / 4 damps most what
/// vibrates fastest.
void resolve_newmark(const AnalysisRecord& record, const OwnKeys& own, AnalysisOptions& options,
                     ProblemList& problems) {
  options.gamma = record.gamma.value_or(0.5);
  const double most_damping = (options.gamma + 0.5) * (options.gamma + 0.5) / 4;
  options.beta =
      record.beta.value_or(std::max(most_damping, options.gamma / 2));  // the first, but for round-off
  if (!own.usable("scheme")) return;
  for (const char* key : {"beta", "gamma"})
    if (own.written(key) && options.scheme != Scheme::newmark)
      problems.error(own.of(key), "'" + std::string(key) + "' belongs to scheme = \"newmark\" alone",
                     "write that scheme or leave '" + std::string(key) + "' out");
  const char* key = own.written("beta") ? "beta" : "gamma";
  if (options.scheme == Scheme::newmark && record.beta && own.written(key) && own.usable("beta") &&
      own.usable("gamma") && 2 * options.beta < options.gamma)
    problems.error(own.of(key),
                   "'beta' = '" + short_number(options.beta) +
                       "' with gamma = " + short_number(options.gamma) + " is not stable at every time step",
                   "2 beta >= gamma is: write a beta of at least " + short_number(options.gamma / 2) +
                       ", or leave it out");
}

/// `own`: who asks, [analysis] or a stage that changed some keys of `record`.
AnalysisOptions resolve(const AnalysisRecord& record, const OwnKeys& own, ProblemList& problems) {
  AnalysisOptions options = record.options;
  const Defaults& preset = defaults_of(options.preset);
  options.block_model = record.block_model.value_or(preset.block_model);
  options.mesh = with_record({}, record.mesh);
  resolve_scheme(record, own, options, problems);
  resolve_newmark(record, own, options, problems);
  options.gradient_correction = record.gradient_correction.value_or(preset.gradient_correction);
  options.cutting_factor = record.cutting_factor.value_or(preset.cutting_factor);
  return options;
}

/// A stiffness that is left out follows from other numbers: it may be beyond what could be written.
double default_stiffness(double value, const char* key, const KeyLocations& locations,
                         ProblemList& problems) {
  if (value > largest_number || (value > 0 && value < smallest_positive))
    problems.error(locations.table,
                   "the default of '" + std::string(key) + "' is '" + rounded(value) + "' N/m2",
                   "write '" + std::string(key) + "' or a moderate 'young'");
  return value;
}

/// The classic method is a plain penalty method: it lets blocks penetrate as deep as its springs need.
double resolve_tolerance(const ContactRecord& record, ContactMethod method, ProblemList& problems) {
  const KeyLocations& locations = record.locations;
  const bool classic = method == ContactMethod::classic;
  const Defaults& of_method = classic ? paper_defaults : standard_defaults;
  const double tolerance = record.penetration_tolerance.value_or(of_method.penetration_tolerance);
  if (classic && tolerance != 0 && locations.good("penetration_tolerance") && locations.usable("method"))
    problems.error(
        locations.of("penetration_tolerance"),
        "'penetration_tolerance' = '" + short_number(tolerance) + "' needs the contact method 'staged'",
        "write 0 or leave it out, or write method = \"staged\"");
  return tolerance;
}

}  // namespace

AnalysisOptions resolve_analysis(const AnalysisRecord& record, ProblemList& problems) {
  return resolve(record, {record.locations, record.locations}, problems);
}

AnalysisOptions resolve_analysis(const AnalysisRecord& of_scene, const StageRecord& stage,
                                 ProblemList& problems) {
  AnalysisRecord record = of_scene;
  AnalysisOptions& options = record.options;
  options.mode = stage.mode.value_or(options.mode);
  options.steps = stage.steps;
  options.time_step = stage.time_step.value_or(options.time_step);
  options.max_displacement_ratio = stage.max_displacement_ratio.value_or(options.max_displacement_ratio);
  options.gravity = stage.gravity.value_or(options.gravity);
  options.damping = stage.damping.value_or(options.damping);
  if (stage.scheme && stage.scheme != Scheme::newmark) record.beta = record.gamma = std::nullopt;
  if (stage.scheme) record.scheme = stage.scheme;
  if (stage.beta) record.beta = stage.beta;
  if (stage.gamma) record.gamma = stage.gamma;
  if (stage.cutting_factor) record.cutting_factor = stage.cutting_factor;
  return resolve(record, {stage.locations, of_scene.locations}, problems);
}

ContactOptions resolve_contact(const ContactRecord& record, Preset preset,
                               const std::vector<Material>& materials, ProblemList& problems) {
  const KeyLocations& locations = record.locations;
  ContactOptions options = record.options;
  options.method = record.method.value_or(defaults_of(preset).method);
  double stiffest = 0;
  for (const Material& material : materials) stiffest = std::max(stiffest, material.young);
  options.normal_stiffness = record.normal_stiffness
                                 ? *record.normal_stiffness
                                 : default_stiffness(40 * stiffest, "normal_stiffness", locations, problems);
  options.tangential_stiffness =
      record.tangential_stiffness
          ? *record.tangential_stiffness
          : default_stiffness(options.normal_stiffness / 2.5, "tangential_stiffness", locations, problems);
  options.penetration_tolerance = resolve_tolerance(record, options.method, problems);
  if (options.method == ContactMethod::classic && options.corner_rounding > 0 && locations.usable("method"))
    problems.error(locations.of("corner_rounding"),
                   "'corner_rounding' = '" + short_number(options.corner_rounding) +
                       "' needs the contact method 'staged'",
                   "write 0 or leave it out, or write method = \"staged\"");
  if (options.method == ContactMethod::classic && options.tolerance && locations.usable("method"))
    problems.error(locations.of("tolerance"), "'tolerance' needs the contact method 'staged'",
                   "leave it out, or write method = \"staged\"");
  return options;
}

}  // namespace ddacontact::scene_format
