#include <ddacontact/scene/resolve.hpp>

#include <ddacontact/scene/crushing_check.hpp>
#include <ddacontact/scene/edge_joint_check.hpp>
#include <ddacontact/scene/free_sides.hpp>
#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/overlap_check.hpp>
#include <ddacontact/scene/quake_check.hpp>
#include <ddacontact/scene/resolve_actions.hpp>
#include <ddacontact/scene/resolve_blocks.hpp>
#include <ddacontact/scene/resolve_bolts.hpp>
#include <ddacontact/scene/resolve_joints.hpp>
#include <ddacontact/scene/resolve_options.hpp>
#include <ddacontact/scene/resolve_stages.hpp>
#include <ddacontact/scene/resolve_water.hpp>
#include <ddacontact/scene/rounding_check.hpp>
#include <ddacontact/scene/scheme_check.hpp>
#include <ddacontact/scene/static_check.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/time/run_warnings.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact::scene_format {

namespace {

/// In kg/m3, from the density or the unit weight; 0 and a problem without either.
double density_of(const MaterialRecord& record, const AnalysisRecord& analysis, ProblemList& problems) {
  const KeyLocations& locations = record.locations;
  const SourceLocation& location = locations.of("unit_weight");
  const std::string cure = "write 'density', in kg/m3";
  if (!locations.written("density") && !locations.written("unit_weight"))
    problems.error(locations.table, "missing key 'density' in [[material]]",
                   "add 'density' in kg/m3, or 'unit_weight' in N/m3");
  if (locations.written("density") && locations.written("unit_weight"))
    problems.error(location, "both 'density' and 'unit_weight' are given", "leave one of them out");
  if (!locations.good("unit_weight") || !analysis.locations.usable("gravity"))
    return record.density.value_or(0);

  const double gravity = analysis.options.gravity.norm();
  const double density = gravity > 0 ? *record.unit_weight / gravity : 0;
  if (gravity == 0)
    problems.error(location, "'unit_weight' without gravity says nothing about the mass", cure);
  else if (!Bounds{smallest_positive, largest_number}.contain(density))
    problems.error(location, "'unit_weight' over gravity is a density of '" + rounded(density) + "' kg/m3",
                   cure);
  if (analysis.options.gravity.x() != 0)
    problems.warning(location,
                     "'unit_weight' is divided by the length of gravity, " + rounded(gravity) +
                         " m/s2: where gravity is tilted to stand for shaking, blocks are lighter than that",
                     cure);
  return density;
}

std::vector<Material> resolve_materials(const Document& document, NameTable& names, ProblemList& problems) {
  std::vector<Material> materials;
  if (document.materials.empty()) names.set_incomplete();  // which is a problem already
  for (const MaterialRecord& record : document.materials) {
    names.add(record.name, record.locations, problems);
    materials.push_back(
        {record.name, density_of(record, document.analysis, problems), record.young, record.poisson});
  }
  return materials;
}

/// Whether the file leaves no doubt about what is held, where the blocks are and what pulls.
bool holds_are_known(const Document& document, const BlockTable& blocks, const Scene& scene) {
  const auto usable = [](const KeyLocations& locations) {
    return locations.usable("mode") && locations.usable("gravity");
  };
  if (!document.has_all_blocks || !usable(document.analysis.locations)) return false;
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    const StageRecord& record = document.stages[s];
    if (!usable(record.locations) || !record.locations.usable("remove") || !record.locations.usable("add") ||
        scene.stages[s].removed.size() != record.remove.blocks.size())
      return false;
  }
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const BlockRecord& record = document.blocks[b];
    if (!blocks.outlines[b].outline.valid() || !record.locations.usable("fixed") ||
        scene.blocks[b].fixed_vertices.size() != record.fixed.some.size())
      return false;
  }
  return std::ranges::none_of(
             scene.supports,
             [](const Support& support) { return support.block < 0 || support.vertices.empty(); }) &&
         std::ranges::all_of(document.supports,
                             [](const SupportRecord& record) { return record.locations.usable("axes"); });
}

/// Of gravity that is more likely a wrong sign than meant.
void warn_of_gravity_upwards(const Document& document, ProblemList& problems) {
  const Vec2& gravity = document.analysis.options.gravity;
  if (gravity.x() != 0 || gravity.y() <= 0 || !document.analysis.locations.good("gravity")) return;
  problems.warning(document.analysis.locations.of("gravity"), "gravity acts upwards",
                   "y points upwards: write gravity = [0, -" + short_number(gravity.y()) + "]");
}

/// Of joints between materials that no two blocks have.
void warn_of_unused_joints(const Document& document, const NameTable& names, const Scene& scene,
                           ProblemList& problems) {
  const auto n_blocks_of = [&](int material) {
    return std::ranges::count(scene.blocks, material, &BlockDescription::material);
  };
  for (std::size_t j = 0; j < document.joints.size(); ++j) {
    const auto& between = scene.joints[j].between;
    if (!between) continue;
    const auto [a, b] = *between;
    if (a == b ? n_blocks_of(a) > 1 : n_blocks_of(a) > 0 && n_blocks_of(b) > 0) continue;
    const bool is_default = j == 0 && std::ranges::all_of(scene.joints, [](const Joint& joint) {
                              return joint.between.has_value();
                            });
    problems.warning(document.joints[j].locations.of("between"),
                     "no two blocks have the materials of 'between' of " + names.title(static_cast<int>(j)) +
                         (is_default ? ": the first of the joints, it is the law of all other contacts"
                                     : ", which is never used"),
                     is_default ? "write the joint of all other contacts first, without 'between'"
                                : "give blocks these materials, or leave the joint out");
  }
}

/// The longest extent of a block of the material along a direction, m.
double tallest(const Scene& scene, int material, const Vec2& direction) {
  double height = 0;
  for (const BlockDescription& block : scene.blocks) {
    if (block.material != material || block.vertices.cols() == 0) continue;
    const auto along = direction.transpose() * block.vertices;
    height = std::max(height, along.maxCoeff() - along.minCoeff());
  }
  return height;
}

/// Of materials whose blocks their own weight deforms much: as a rule the unit of `young` is missing.
void warn_of_soft_materials(const Document& document, const Scene& scene, ProblemList& problems) {
  const double g = scene.analysis.gravity.norm();
  if (!(g > 0)) return;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!document.materials[m].locations.usable("young") || !(material.young > 0)) continue;
    const double strain = material.density * g *
                          tallest(scene, static_cast<int>(m), scene.analysis.gravity / g) / material.young;
    if (!(strain > large_strain)) continue;
    problems.warning(document.materials[m].locations.of("young"),
                     "material \"" + material.name + "\" is strained by its weight by " +
                         std::to_string(static_cast<long>(std::min(100 * strain, 1e12))) +
                         " %, and elasticity is linear, for small strains",
                     "is 'young' right? Without a unit it is in Pa; write young = \"20 GPa\"");
  }
}

/// Of joints that give way so much under the blocks on them that these may pass through others: as a rule
/// the unit of `normal_stiffness` is missing.
void warn_of_soft_joints(const Document& document, const Scene& scene, ProblemList& problems) {
  constexpr double large_closure = 0.1;  // over the height of what rests on it
  double density = 0;
  for (const Material& material : scene.materials) density = std::max(density, material.density);
  for (std::size_t j = 0; j < document.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (!joint.normal_stiffness || !document.joints[j].locations.good("normal_stiffness")) continue;
    const double closure = density * scene.analysis.gravity.norm() / *joint.normal_stiffness;
    if (!(closure > large_closure)) continue;
    problems.warning(
        document.joints[j].locations.of("normal_stiffness"),
        "joint \"" + joint.name + "\" closes by " +
            std::to_string(static_cast<long>(std::min(100 * closure, 1e12))) +
            " % of the height of each block on it, by its weight: blocks may pass through others",
        "is 'normal_stiffness' right? Without a unit it is in Pa/m; write \"5 GPa/m\"");
  }
}

/// The same of penalty springs, which bear what two blocks press on each other with.
void warn_of_soft_springs(const Document& document, const Scene& scene, ProblemList& problems) {
  constexpr double large_penetration = 0.1;  // over the size of the block
  if (scene.contact.method != ContactMethod::classic || !document.contact.locations.good("normal_stiffness"))
    return;
  const double g = scene.analysis.gravity.norm();
  const bool sink = std::ranges::any_of(scene.blocks, [&](const BlockDescription& block) {
    const double area = std::abs(polyfem::signed_area(block.vertices)),
                 weight = area * scene.materials[block.material].density * g;
    return !block.fixed && weight > large_penetration * std::sqrt(area) * scene.contact.normal_stiffness;
  });
  if (!sink) return;
  problems.warning(document.contact.locations.of("normal_stiffness"),
                   "blocks sink into such soft springs by more than a tenth of their size: they may pass "
                   "through others",
                   "is 'normal_stiffness' right? It is in N/m; left out, 40 times the Young's modulus");
}

/// From cork to lead: what blocks are made of, kg/m3.
constexpr Bounds usual_density{.low = 100, .high = 12000};

/// Warns of densities that no usual material has: as a rule a number meant in another unit.
void warn_of_unusual_densities(const Document& document, const Scene& scene, ProblemList& problems) {
  const double g = scene.analysis.gravity.norm();
  if (!(g > 0)) return;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const MaterialRecord& record = document.materials[m];
    const char* key = record.unit_weight ? "unit_weight" : "density";
    if (!record.locations.good(key) || (record.density && record.unit_weight) || !(material.density > 0) ||
        usual_density.contain(material.density))
      continue;
    const double value = record.unit_weight ? *record.unit_weight : material.density;
    const std::string number = short_number(value);
    std::string cure = "is it right? 'density' is in kg/m3, 'unit_weight' in N/m3";
    if (usual_density.contain(1000 * value))
      cure += "; if it is in t/m3, write density = \"" + number + " t/m3\"";
    else if (usual_density.contain(1000 * value / g))
      cure += "; if it is in kN/m3, write unit_weight = \"" + number + " kN/m3\"";
    else if (usual_density.contain(value / g))
      cure += "; if it is in N/m3, write unit_weight = " + number;
    problems.warning(record.locations.of(key),
                     "material \"" + material.name + "\" has a density of " + rounded(material.density) +
                         " kg/m3, unusually " + (material.density < usual_density.low ? "light" : "heavy"),
                     cure);
  }
}

}  // namespace

Scene resolve(const Document& document, ProblemList& problems) {
  Scene scene;
  scene.title = document.title;
  scene.analysis = resolve_analysis(document.analysis, problems);
  scene.analysis.skip = document.solver.skip;
  NameTable materials("material");
  scene.materials = resolve_materials(document, materials, problems);
  scene.contact =
      resolve_contact(document.contact, document.analysis.options.preset, scene.materials, problems);
  NamedJoints joints = resolve_joints(document, materials, scene.contact.method, problems);

  BlockTable blocks = resolve_blocks(document, scene.analysis, materials, joints.names, problems);
  scene.blocks = std::move(blocks.descriptions);
  scene.supports = resolve_supports(document, blocks, problems);
  scene.loads = resolve_loads(document, blocks, problems);
  scene.water = resolve_water(document, problems);
  scene.quakes = resolve_quakes(document, problems);
  scene.quiet_boundaries = resolve_quiet_boundaries(document, blocks, problems);
  ResolvedBolts bolts = resolve_bolts(document, blocks, scene.blocks, scene.contact.method, problems);
  scene.bolts = std::move(bolts.bolts);
  scene.monitors = resolve_monitors(document, blocks, problems);
  for (std::size_t i = 0; i < blocks.outlines.size(); ++i)
    blocks.outlines[i].held = blocks.holds.holds_all(i);
  if (std::ranges::all_of(blocks.outlines, [](const PositionedOutline& of) { return of.outline.valid(); })) {
    check_corner_rounding(document, scene, blocks, problems);
    warn_of_vertices_in_crushed_faces(document, blocks, problems);
  }
  scene.stages = resolve_stages(document, scene, joints, blocks, bolts.names, problems);
  for (int k = 0; k < static_cast<int>(scene.stages.size()); ++k) {
    for (const int b : scene.stages[k].added) blocks.outlines[b].comes = k;
    for (const int b : scene.stages[k].removed) blocks.outlines[b].goes = k;
  }
  bring_bolts(document, bolts, blocks, scene.stages, problems);
  const bool apart = check_overlaps(blocks.outlines, blocks.names, problems);
  scene.joints = std::move(joints.joints);
  if (apart && !problems.has_errors()) warn_of_two_joints_on_a_face(scene, blocks, problems);
  if (apart && holds_are_known(document, blocks, scene)) {
    check_statics(blocks, static_parts(scene), bolts.blocks, problems);
    warn_of_free_sides(document, scene, blocks, problems);
  }

  warn_of_gravity_upwards(document, problems);
  warn_of_soft_materials(document, scene, problems);
  warn_of_soft_joints(document, scene, problems);
  warn_of_soft_springs(document, scene, problems);
  warn_of_unusual_densities(document, scene, problems);
  scene.output = document.output.options;
  scene.domain = document.domain_counts;
  scene.snapped = document.snapped;
  if (problems.has_errors()) return scene;
  warn_of_early_quakes(document, scene, problems);
  warn_of_unused_joints(document, joints.names, scene, problems);
  scene.analysis.steps = scene.n_steps();
  std::vector<bool> may_turn;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) may_turn.push_back(!blocks.holds.holds_all(b));
  check_scheme(document, scene, blocks.names, may_turn, problems);
  return scene;
}

}  // namespace ddacontact::scene_format
