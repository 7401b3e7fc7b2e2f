#include <ddacontact/scene/memory_estimate.hpp>

#include <ddacontact/scene/model_choice.hpp>
#include <ddacontact/solver/contact_sweeps.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ddacontact {

namespace {

// Bytes measured in runs of walls of 1e3 to 1e5 blocks of each model; see tests/apps/memory_test.cpp.
constexpr double program = 16e6;
constexpr double of_scene_block = 900, of_scene_vertex = 60;
constexpr double of_block = 700, of_vertex = 400, of_cell = 2500, of_unknown_pair = 24;
constexpr double of_contact = 900, contacts_of_vertex = 1.5;
constexpr double of_matrix_entry = 36, of_swept_entry = 8, of_swept_contact = 600;
constexpr double of_box_pair = 24;
/// Entries of the factor: so many n log2 n of n rows; bytes of each, in L and U, and of what waits for its front.
constexpr double fill = 7, of_factor_entry = 22;

/// What counts of a block.
struct Size {
  double unknowns = 0, cells = 1;
  double of_cell = 0;  ///< unknowns of each
};

Size size_of(const BlockDescription& block) {
  const double n = static_cast<double>(block.vertices.cols());
  if (block.model == BlockModel::affine) return {6, 1, 6};
  if (block.model != BlockModel::mesh) return {2 * n, 1, 2 * n};
  // A Voronoi cell brings two corners, a quadrilateral one.
  const double cells = block.mesh.cells;
  const bool quads = block.mesh.kind == CellKind::quads || (block.mesh.kind == CellKind::by_shape && n == 4);
  return {2 * ((quads ? 1 : 2) * cells + 4 * std::sqrt(cells)), cells, quads ? 8. : 12.};
}

/// Whether waves take longer than dt to cross the block.
bool is_crossed_later(const BlockDescription& block, const Material& rock, Plane plane, double dt) {
  const double size = std::sqrt(std::abs(polyfem::signed_area(block.vertices)));
  const double stiffness = polyfem::elasticity_matrix(rock.young, rock.poisson, plane)(0, 0);
  return dt < size / std::sqrt(stiffness / rock.density);
}

double factor_bytes(double n_rows) {
  return n_rows > 1 ? of_factor_entry * fill * n_rows * std::log2(n_rows) : 0;
}

}  // namespace

bool needs_factor(const Scene& scene) {
  std::vector<AnalysisOptions> parts;
  for (const StageDescription& stage : scene.stages) parts.push_back(stage.analysis);
  if (parts.empty()) parts.push_back(scene.analysis);
  double longest = 0;
  for (const AnalysisOptions& part : parts) {
    if (part.mode == Mode::statics || !part.skip.cg) return true;
    longest = std::max(longest, part.time_step);
  }
  if (scene.contact.method != ContactMethod::staged) return true;
  return std::any_of(scene.blocks.begin(), scene.blocks.end(), [&](const BlockDescription& block) {
    if (block.fixed) return false;
    const bool may_be_divided = block.model == BlockModel::automatic &&
                                scene.analysis.kinematics == Kinematics::corotational &&
                                may_bend_in_motion(block.vertices);
    return may_be_divided || block.model == BlockModel::mesh ||
           size_of(block).unknowns > ContactSweeps::largest_block ||
           !is_crossed_later(block, scene.materials[block.material], scene.analysis.plane, longest);
  });
}

std::string bytes_text(double bytes) {
  std::array<char, 32> text{};
  if (bytes < 1e9)
    std::snprintf(text.data(), text.size(), "%.0f MB", bytes / 1e6);
  else
    std::snprintf(text.data(), text.size(), "%.1f GB", bytes / 1e9);
  return text.data();
}

double least_memory(double n_blocks, double n_box_pairs) {
  constexpr double n_vertices = 4;
  const double of_one = of_scene_block + of_block + of_cell +
                        n_vertices * (of_scene_vertex + of_vertex + of_contact * contacts_of_vertex);
  return program + n_blocks * of_one + n_box_pairs * of_box_pair;
}

MemoryEstimate estimate_memory(const Scene& scene) {
  MemoryEstimate e;
  e.has_factor = needs_factor(scene);
  e.scene = program;
  for (const BlockDescription& block : scene.blocks) {
    const double n = static_cast<double>(block.vertices.cols());
    const Size size = size_of(block);
    const double pairs = size.cells * size.of_cell * size.of_cell;
    e.scene += of_scene_block + of_scene_vertex * n;
    e.blocks += of_block + of_vertex * n + of_cell * size.cells + of_unknown_pair * pairs;
    e.contacts += of_contact * contacts_of_vertex * n;
    const double of_a_contact = block.model == BlockModel::affine ? 36 : 8;
    e.matrix += e.has_factor ? of_matrix_entry * (pairs / 2 + contacts_of_vertex * n * of_a_contact)
                             : of_swept_entry * pairs + of_swept_contact * contacts_of_vertex * n;
    if (!block.fixed) e.n_rows += size.unknowns;
  }
  if (e.has_factor) e.factor = factor_bytes(e.n_rows);
  return e;
}

double part_that_fits(const MemoryEstimate& estimate, double bytes) {
  const double proportional = estimate.total() - estimate.factor - program;
  const auto factor = [&](double part) {
    return estimate.has_factor ? factor_bytes(part * estimate.n_rows) : 0;
  };
  double fits = 0, too_much = 1;
  while (too_much - fits > 1e-3) {
    const double part = (fits + too_much) / 2;
    (program + part * proportional + factor(part) > bytes ? too_much : fits) = part;
  }
  return fits;
}

}  // namespace ddacontact
