#include <ddacontact/scene/resolve.hpp>

#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/overlap_check.hpp>
#include <ddacontact/scene/resolve_actions.hpp>
#include <ddacontact/scene/resolve_blocks.hpp>
#include <ddacontact/scene/resolve_options.hpp>
#include <ddacontact/scene/static_check.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

void refuse_unless_zero(double value, const char* key, const Places& places, ProblemList& problems) {
  if (value == 0 || !places.good(key)) return;
  problems.error(places.of(key), "'" + std::string(key) + "' other than 0 is " + not_available_text,
                 "write 0 or leave it out");
}

/// In kg/m3, from the density or the unit weight; 0 and a problem without either.
double density_of(const MaterialRecord& record, const AnalysisRecord& analysis, ProblemList& problems) {
  const Places& places = record.places;
  const Place& place = places.of("unit_weight");
  const std::string cure = "write 'density', in kg/m3";
  if (!places.written("density") && !places.written("unit_weight"))
    problems.error(places.table, "missing key 'density' in [[material]]",
                   "add 'density' in kg/m3, or 'unit_weight' in N/m3");
  if (places.written("density") && places.written("unit_weight"))
    problems.error(place, "both 'density' and 'unit_weight' are given", "leave one of them out");
  if (!places.good("unit_weight") || !analysis.places.usable("gravity")) return record.density.value_or(0);

  const double gravity = analysis.options.gravity.norm();
  const double density = gravity > 0 ? *record.unit_weight / gravity : 0;
  if (gravity == 0)
    problems.error(place, "'unit_weight' without gravity says nothing about the mass", cure);
  else if (!Bounds{smallest_positive, largest_number}.contain(density))
    problems.error(place, "'unit_weight' over gravity is a density of '" + rounded(density) + "' kg/m3",
                   cure);
  return density;
}

std::vector<Material> resolve_materials(const Document& document, NameTable& names, ProblemList& problems) {
  std::vector<Material> materials;
  for (const MaterialRecord& record : document.materials) {
    names.add(record.name, record.places, problems);
    materials.push_back(
        {record.name, density_of(record, document.analysis, problems), record.young, record.poisson});
  }
  return materials;
}

/// Springs let blocks bounce as they please: only the staged method can give what is asked for.
void check_restitution(const JointRecord& record, const ContactRecord& contact, ContactMethod method,
                       ProblemList& problems) {
  if (method != ContactMethod::classic || record.joint.restitution == 0) return;
  if (!record.places.good("restitution") || !contact.places.usable("method")) return;
  problems.error(
      record.places.of("restitution"),
      "'restitution' = '" + short_number(record.joint.restitution) + "' needs the contact method 'staged'",
      "leave it out, or write method = \"staged\" in [contact]");
}

std::vector<Joint> resolve_joints(const Document& document, const NameTable& materials, ContactMethod method,
                                  ProblemList& problems) {
  NameTable names("joint");
  std::vector<Joint> joints;
  for (const JointRecord& record : document.joints) {
    const Places& places = record.places;
    names.add(record.name, places, problems);
    Joint joint = record.joint;
    joint.name = record.name.value_or("");
    check_restitution(record, document.contact, method, problems);
    if (record.between && places.good("between")) {
      const int a = materials.find((*record.between)[0], places.of("between"), problems);
      const int b = materials.find((*record.between)[1], places.of("between"), problems);
      if (a >= 0 && b >= 0) joint.between = std::array<int, 2>{std::min(a, b), std::max(a, b)};
      for (std::size_t other = 0; joint.between && other < joints.size(); ++other)
        if (joints[other].between == joint.between)
          problems.error(places.of("between"),
                         "the two materials already follow " + names.title(static_cast<int>(other)),
                         "leave one 'between' out");
    } else if (!record.between && !joints.empty()) {
      problems.warning(places.table,
                       names.title(names.size() - 1) +
                           " is never used: it has no 'between' and only the first joint is the default",
                       "add 'between'");
    }
    joints.push_back(std::move(joint));
  }
  if (joints.empty()) joints.push_back({.name = "default", .between = std::nullopt});
  return joints;
}

/// Whether the file leaves no doubt about what is held, where the blocks are and what pulls.
bool holds_are_known(const Document& document, const BlockTable& blocks, const Scene& scene) {
  const Places& analysis = document.analysis.places;
  if (!document.has_all_blocks || !analysis.usable("mode") || !analysis.usable("gravity")) return false;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const BlockRecord& record = document.blocks[b];
    if (!blocks.outlines[b].outline.sound() || !record.places.usable("fixed") ||
        scene.blocks[b].fixed_vertices.size() != record.fixed.some.size())
      return false;
  }
  return std::none_of(scene.supports.begin(), scene.supports.end(),
                      [](const Support& support) { return support.block < 0 || support.vertices.empty(); });
}

}  // namespace

Scene resolve(const Document& document, ProblemList& problems) {
  Scene scene;
  scene.title = document.title;
  scene.analysis = resolve_analysis(document.analysis, problems);
  NameTable materials("material");
  scene.materials = resolve_materials(document, materials, problems);
  scene.contact =
      resolve_contact(document.contact, document.analysis.options.preset, scene.materials, problems);
  scene.joints = resolve_joints(document, materials, scene.contact.method, problems);

  BlockTable blocks = resolve_blocks(document, scene.analysis, materials, problems);
  scene.blocks = std::move(blocks.descriptions);
  scene.supports = resolve_supports(document, blocks, problems);
  scene.loads = resolve_loads(document, blocks, problems);
  scene.monitors = resolve_monitors(document, blocks, problems);
  for (std::size_t i = 0; i < blocks.outlines.size(); ++i)
    blocks.outlines[i].held = blocks.holds.holds_all(i);
  const bool apart = check_overlaps(blocks.outlines, blocks.names, problems);
  if (scene.analysis.mode == Mode::statics && apart && holds_are_known(document, blocks, scene))
    check_statics(blocks, scene.analysis.gravity, problems);

  scene.output = document.output.options;
  refuse_unless_zero(scene.output.checkpoint_every, "checkpoint_every", document.output.places, problems);
  return scene;
}

}  // namespace ddacontact::scene_format
