#include <ddacontact/scene/model_choice.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/validity.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double least_turn = 0.035;  ///< the sine of two degrees
constexpr double least_slenderness = 2.5;
constexpr double largest_missing = 0.03;
constexpr int cells_across = 2, cells_across_slender = 4, most_cells_of_a_block = 400;
/// Two vertices a cell; and what is allowed in all.
constexpr long unknowns_per_cell = 4, most_unknowns_of_squat = 4'000, most_unknowns_of_slender = 200'000;
/// Forces below this part of a block's weight are none.
constexpr double least_load = 1e-3;
/// Stress counts at least as this part of the largest in the scene, by energy density.
constexpr double least_density = 0.1;

/// Meshes bend, and load others in another way than polygons that do not: looked at again, so often at most.
constexpr int most_rounds = 3;

/// Unknowns of the meshes of a kind of block.
struct Budget {
  long most, asked = 0;
};

/// What a block is to be.
struct Division {
  std::size_t block;
  MeshOptions mesh;
  std::string reason;
  Budget* budget;
};

struct ChoiceByShape {
  BlockModel model;
  std::string reason;
};

/// Rule 1, of a counter-clockwise outline.
ChoiceByShape choose_by_shape(const PointsRef& outline) {
  const auto corner = polyfem::find_non_convex_corner(outline, least_turn);
  if (!corner) return {BlockModel::wachspress, "convex"};
  const Index n = outline.cols();
  const Vec2 in = outline.col(*corner) - outline.col((*corner + n - 1) % n),
             out = outline.col((*corner + 1) % n) - outline.col(*corner);
  return {BlockModel::mean_value,
          cross(in, out) < -least_turn * in.norm() * out.norm() ? "concave" : "a corner is next to straight"};
}

bool rests_throughout(const Scene& scene) {
  const auto rests = [](const AnalysisOptions& analysis) { return analysis.mode == Mode::statics; };
  return scene.stages.empty() ? rests(scene.analysis)
                              : std::ranges::all_of(scene.stages, rests, &StageDescription::analysis);
}

}  // namespace

double slenderness(const PointsRef& outline) {
  const Vec2 moments =  // of a clockwise outline both are negative
      Eigen::SelfAdjointEigenSolver<Mat2>(polyfem::area_moments(outline).second, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .cwiseAbs();
  return std::sqrt(moments.maxCoeff() / moments.minCoeff());
}

bool may_bend_in_motion(const PointsRef& outline) {
  return slenderness(outline) > least_slenderness;
}

ChosenModels choose_models(
    const Scene& scene,
    const std::function<std::vector<double>(const Scene&, const std::vector<std::string>&)>& missing) {
  ChosenModels chosen{scene, std::vector<std::string>(scene.blocks.size())};
  std::vector<std::size_t> may_bend;
  const bool at_rest = rests_throughout(scene),
             crushes = std::ranges::any_of(
                 scene.joints, [](const Joint&joint) { return joint.compressive_strength.has_value(); });
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    BlockDescription& block = chosen.scene.blocks[b];
    if (block.model != BlockModel::automatic) continue;
    Points outline = block.vertices;
    if (polyfem::signed_area(outline) < 0) outline = outline.rowwise().reverse().eval();
    const ChoiceByShape by_shape = choose_by_shape(outline);
    block.model = by_shape.model;
    chosen.reasons[b] = by_shape.reason;
    if (block.fixed)
      chosen.reasons[b] = "held, " + chosen.reasons[b];
    else if (scene.analysis.kinematics == Kinematics::corotational && !crushes &&
             (at_rest || may_bend_in_motion(outline)))
      may_bend.push_back(b);
  }
  Budget squat{most_unknowns_of_squat}, slender{most_unknowns_of_slender};
  for (int round = 0; round < most_rounds && !may_bend.empty(); ++round) {
    const std::vector<double> share = missing(chosen.scene, chosen.reasons);
    std::vector<Division> divisions;
    for (std::size_t b : may_bend) {
      const double ratio = slenderness(chosen.scene.blocks[b].vertices);
      const bool is_slender = ratio > least_slenderness, known = share[b] >= 0;
      if (known ? share[b] <= largest_missing : !is_slender) continue;
      if (!is_slender && chosen.scene.blocks[b].model == BlockModel::mean_value) continue;
      Division division{b, {}, {}, is_slender ? &slender : &squat};
      const int across = is_slender ? cells_across_slender : cells_across;
      division.mesh.cells =
          static_cast<int>(std::lround(std::min<double>(across * across * ratio, most_cells_of_a_block)));
      division.reason = share[b] == inf ? "supports deform it"
                        : known ? "bent (" + scene_format::rounded(100 * share[b]) + " % of its stress)"
                                : "slender (" + scene_format::rounded(ratio) + ":1), its load not known";
      division.budget->asked += unknowns_per_cell * division.mesh.cells;
      divisions.push_back(std::move(division));
    }
    bool any_divided = false;
    for (const Division& division : divisions) {
      BlockDescription& block = chosen.scene.blocks[division.block];
      std::string& reason = chosen.reasons[division.block];
      std::erase(may_bend, division.block);
      if (division.budget->asked > division.budget->most) {
        reason += ", bent, but there are too many such blocks to divide them";
        continue;
      }
      block.model = BlockModel::mesh;
      block.mesh = division.mesh;
      reason = division.reason;
      any_divided = true;
    }
    if (!any_divided) break;  // blocks are loaded as before
  }
  return chosen;
}

std::vector<double> missing_bending(const BlockSystem& blocks, const BlockState& initial,
                                    const FirstLoading& loading) {
  const auto n = static_cast<std::size_t>(blocks.n_blocks());
  std::vector<double> total(n, 0), missing(n, -1), absent(n, 0);
  double largest_density = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    if (blocks.is_unchanging(b)) continue;
    const auto [first, count] = block.vertices();
    const Points outline =
        initial.position.middleCols(first, count).colwise() - block.moments(initial).centroid;
    double sum = 0;
    for (const ActingForce& acting : loading.forces[b]) sum += acting.force.norm();
    if (sum <= least_load * block.mass_total() * blocks.gravity.norm()) continue;

    polyfem::PolygonRule rule;
    polyfem::make_polygon_rule(outline, polyfem::hammer_rule(5), rule);
    const Mat3 compliance = block.material().elasticity.inverse();
    const StressMoments asked = moments_of_forces(
        rule, loading.forces[b], block.mass_total() / block.reference_area() * blocks.gravity);
    absent[b] = energy_of_bending(rule, compliance, asked - loading.moments[b]);
    const Vec3& mean = loading.mean[b];
    total[b] =
        block.reference_area() * mean.dot(compliance * mean) / 2 + energy_of_moments(rule, compliance, asked);
    largest_density = std::max(largest_density, total[b] / block.reference_area());
    missing[b] = 0;
  }
  for (std::size_t b = 0; b < n; ++b)
    if (missing[b] == 0 && absent[b] > 0)
      missing[b] =
          std::sqrt(absent[b] / std::max(total[b], least_density * largest_density *
                                                       blocks.block(static_cast<int>(b)).reference_area()));
  return missing;
}

}  // namespace ddacontact
