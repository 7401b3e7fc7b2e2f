#include <ddacontact/scene/guessed_keys.hpp>

#include <ddacontact/scene/catalog.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

/// Some keys in some table; of a key that stands more than once the first counts.
struct Guess {
  std::string_view table;  ///< a part of how messages call it; empty: any
  std::string_view keys;   ///< in small letters, a blank before and after each
  std::string_view cure;
};

constexpr std::string_view joint_stiffness =
    "a joint's own 'normal_stiffness' and 'shear_stiffness' stand in [[joint]], in Pa/m; without them it is "
    "rigid";
constexpr std::string_view strength_of_joints =
    "blocks are linear elastic and do not break: strength is that of contacts, 'friction_angle', 'cohesion' "
    "and 'tensile_strength' of [[joint]]";
constexpr std::string_view shaking =
    "a constant acceleration is 'gravity' of [analysis], that of the ground [[quake]] with 'acceleration' = "
    "[[t, ax, ay], ...] or a file";

constexpr Guess guesses[] = {
    // Laws of contacts.
    {"joint", " kn k_n jkn knorm ks k_s jks kt tangential_stiffness stiffness joint_stiffness ",
     joint_stiffness},
    {"joint", " phi friction fric jfriction jfric jfr friction_deg angle ",
     "write 'friction_angle' in degrees"},
    {"joint", " mu friction_coefficient coefficient coef ", "write 'friction_angle' = atan(mu) in degrees"},
    {"joint", " c coh jcohesion jcoh ", "write 'cohesion' in Pa"},
    {"joint", " tension tens jtension jtens tensile sigma_t ft ", "write 'tensile_strength' in Pa"},
    {"joint", " dilation dilatancy jdilation jdil psi zdilation ",
     "write 'dilation_angle' in degrees and 'dilation_slip' in m"},
    {"joint", " ucs fc sigma_c f_c crushing_strength ", "write 'compressive_strength' in Pa"},
    {"joint", " residual_friction jrfric resfric ", "write 'residual_friction_angle' in degrees"},
    {"joint", " jrescoh residual_cohesion ",
     "there is none: 'cohesion' and 'tensile_strength' are lost on sliding or opening"},
    {"joint", " damping ", "write 'dashpot', a ratio to critical damping"},
    {"[contact]", " kn k_n penalty pn stiffness normal_penalty ", "write 'normal_stiffness' in N/m2"},
    {"[contact]", " ks k_s kt shear_stiffness tangential_penalty shear_penalty ",
     "write 'tangential_stiffness' in N/m2"},
    {"[contact]",
     " mu phi friction friction_angle friction_coefficient cohesion tensile_strength tension "
     "restitution dashpot damping ",
     "the laws of contacts are [[joint]]"},
    {"[contact]", " joint_stiffness ", joint_stiffness},

    // Materials.
    {"[[material]]", " e ym youngs_modulus young_modulus youngs modulus elastic_modulus elasticity ",
     "write 'young' in Pa"},
    {"[[material]]", " nu v pr poissons_ratio poisson_ratio poissons ", "write 'poisson'"},
    {"[[material]]", " rho ro dens mass_density ", "write 'density' in kg/m3"},
    {"[[material]]", " gamma weight specific_weight ", "write 'unit_weight' in N/m3"},
    {"[[material]]", " bulk bulk_modulus k g shear shear_modulus lambda ",
     "write 'young' and 'poisson': with bulk modulus K and shear modulus G, young = 9KG/(3K + G) and poisson "
     "= "
     "(3K - 2G)/(6K + 2G)"},
    {"[[material]]",
     " phi friction friction_angle cohesion c coh tension tensile_strength strength ucs ft fc "
     "yield dilation ",
     strength_of_joints},
    {"[[material]]", " damping ", "write 'damping' = { mass, stiffness } in [analysis]"},
    {"[[material]]", " kn ks joint_stiffness ", joint_stiffness},

    // Blocks.
    {"[[block]]", " id label title ", "write 'name'"},
    {"[[block]]", " fix ", "write 'fixed' = true or a list of vertices"},
    {"[[block]]", " mat ", "write 'material'"},
    {"[[block]]", " points coordinates coords polygon nodes corners outline xy ",
     "write 'vertices' = [[x, y], ...] in m"},
    {"[[block]]", " e young nu poisson density rho unit_weight ",
     "these are of its [[material]], which 'material' names"},
    {"[[block]]", " friction friction_angle phi cohesion kn ks ",
     "the laws of contacts are [[joint]], by pairs of materials where 'between' names them"},
    {"[[block]]", " force load pressure ", "forces are [[load]]"},
    {"[[block]]", " groups tag tags ", "write 'group' = a name or a list of names"},
    {"[[block]]", " copies repeat array count ",
     "write 'grid' = { count = [n, m], step = [x, y] }: it copies the block"},
    {"[[block]]", " rotation angle spin omega ",
     "a block starts as its 'vertices' are; 'angular_velocity' in rad/s turns it"},

    // Loads and supports.
    {"[[load]]", " p pressure magnitude stress ",
     "a pressure is type = \"pressure\" with 'edge' and 'value' in Pa"},
    {"[[load]]", " fx fy direction ", "write 'force' = [fx, fy]"},
    {"[[load]]", " position point location vertex ",
     "write 'at' = [x, y], inside the block or on its outline"},
    {"[[load]]", " acceleration ",
     "a body force is per volume: density times acceleration; one of all blocks is "
     "'gravity' of [analysis]"},
    {"[[support]]", " acceleration ", "write 'acceleration_history' = [[t, ax, ay], ...] or a file"},
    {"[[support]]", " fixed fix ", "'axes' says which directions are held, \"xy\" unless written"},
    {"[[support]]", " vertex node nodes ", "write 'vertices' = [k, ...]"},
    {"[[support]]", " stiffness spring ", "supports are rigid in this version"},

    {"[water]", " level height head depth surface y ", "write 'table' = [[0, LEVEL]]"},

    {"[[domain.joint_set]]", " dip dip_angle inclination ",
     "write 'angle': of the traces in the plane of the scene, counter-clockwise from x; for joints that do "
     "not strike across it that is their apparent dip"},
    {"[[domain.joint_set]]", " persistence continuity ",
     "write 'trace' and 'gap': the persistence is trace / (trace + gap)"},

    // How a run goes.
    {"[analysis]", " dt timestep step delta_t h ", "write 'time_step' in s"},
    {"[analysis]", " nsteps n_steps num_steps max_steps cycles cycle ", "write 'steps'"},
    {"[analysis]", " time end_time total_time duration t_end tmax ",
     "write 'steps': that many steps of 'time_step'"},
    {"[analysis]", " g ", "write 'gravity' = [0, -9.8] in m/s2"},
    {"[analysis]", " acceleration quake ", shaking},
    {"[analysis]", " local_damping damp auto_damping viscous_damping damping_ratio alpha alpha_damping ",
     "write 'damping' = { mass, stiffness }, forces mass M v and stiffness K times the rate of deformation; "
     "a "
     "static 'mode' brings blocks to rest without"},
    {"[analysis]", " type analysis_type ", "write 'mode' = \"dynamic\" or \"static\""},
    {"[analysis]", " dynamic static ", "write 'mode' = \"dynamic\" or \"static\""},
    {"[analysis]", " until ", "it belongs to a [[stage]]"},
    {"[analysis]", " friction friction_angle phi ", "the laws of contacts are [[joint]]"},
    {"[analysis]", " kn ks stiffness penalty normal_stiffness tangential_stiffness ",
     "write 'normal_stiffness' and 'tangential_stiffness' in [contact]"},
    {"[analysis]", " thickness ", "it is 1 m: forces are per metre of thickness"},
    {"[analysis]", " threads ", "it is an option of the program: dda run SCENE.toml --threads N"},

    {"[[stage]]", " support supports load loads quake bolt ",
     "it stands beside the stages: a 'history' is in times of the run, and 'add' of the stage brings loads, "
     "bolts and blocks"},

    // Tables that there are not.
    {"the scene", " schema version ", "write 'format' = 1"},
    {"the scene", " pore_pressure groundwater water_table fluid piezometric_line ",
     "write [water] with 'table' = [[x, y], ...]"},
    {"the scene", " bolts rockbolt anchor anchors cable reinforcement ", "write [[bolt]]"},
    {"the scene", " earthquake seismic acceleration ground_motion ", shaking},
    {"the scene", " viscous_boundary absorbing_boundary ",
     "write [[quiet_boundary]] with 'on' = [[x, y], [x, y]]"},
    {"the scene", " joint_set jset voronoi region opening tunnel trace ",
     "they belong to [domain]: [[domain.joint_set]], [[domain.opening]], ..."},
    {"the scene", " insitu in_situ ",
     "write [initial_stress] with 'stress', 'gradient' and 'level', or 'stress' of a [[block]]"},
    {"the scene", " variables parameter ",
     "write [parameters] and \"$NAME\" wherever one of its numbers stands"},
    {"the scene", " gravity steps time_step dt mode scheme damping ", "it belongs to [analysis]"},
    {"the scene", " kn ks normal_stiffness tangential_stiffness penalty ",
     "write 'normal_stiffness' and 'tangential_stiffness' in [contact]"},
    {"the scene", " friction friction_angle cohesion interface interfaces law laws ",
     "the laws of contacts are [[joint]]"},
    {"the scene", " young poisson density e nu rho ", "they belong to [[material]]"},
    {"the scene", " boundary boundaries bc fixed constraint constraints ",
     "blocks are held by 'fixed' of [[block]] and by [[support]]"},
    {"the scene", " history histories ", "motion of points in time is written of each [[monitor]]"},
    {"the scene", " solve run ", "steps are those of [analysis] or of each [[stage]]"},
};

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// "it belongs to [solver]": the tables that have a key of that name or beginning with it and a dot; empty
/// where there are none, or so many that they say nothing.
std::string where_it_belongs(std::string_view key) {
  constexpr int most = 3;
  const std::string beginning = std::string(key) + '.';
  std::string where;
  int found = 0;
  for (const CatalogEntry& entry : catalog()) {
    if (std::ranges::none_of(
            entry.keys, [&](std::string_view known) { return known == key || known.starts_with(beginning); }))
      continue;
    const bool several = entry.kind == CatalogEntry::Kind::tables;
    where += (found++ ? " or " : "it belongs to ") + std::string(several ? "[[" : "[") +
             std::string(entry.name) + (several ? "]]" : "]");
  }
  return found <= most ? where : "";
}

}  // namespace

std::string_view cure_of_guessed_key(std::string_view key, std::string_view table) {
  std::string word = " " + std::string(key) + ' ';
  std::ranges::transform(word, word.begin(), lower);
  if (key.find(' ') != std::string_view::npos) return {};
  for (const Guess& guess : guesses)
    if (table.find(guess.table) != std::string_view::npos && guess.keys.find(word) != std::string_view::npos)
      return guess.cure;
  return {};
}

std::string cure_of_unknown_key(std::string_view key, std::string_view table,
                                const std::vector<std::string_view>& known) {
  if (const std::string_view cure = cure_of_guessed_key(key, table); !cure.empty()) return std::string(cure);
  const std::string elsewhere = where_it_belongs(key);
  return elsewhere.empty() ? suggestion(key, "key", known) : elsewhere;
}

}  // namespace ddacontact::scene_format
