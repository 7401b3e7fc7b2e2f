/// \file Options of an analysis, with the defaults.
#pragma once

#include <ddacontact/core/skips.hpp>
#include <ddacontact/core/types.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <optional>

namespace ddacontact {

using polyfem::GradientCorrection;
using polyfem::Plane;

/// Set of defaults; written "default", "paper".
enum class Preset { standard, paper };
/// Velocities carry over | every step starts at rest.
enum class Mode { dynamic, statics };
/// The unknowns of a block: displacements of its vertices, by Wachspress functions or by mean value ones |
/// the six of (1) | displacements of the vertices of polygons that fill it | whichever of these is enough.
enum class BlockModel { wachspress, mean_value, affine, mesh, automatic };
/// The cells of BlockModel::mesh; by_shape: quads in convex quadrilaterals, else Voronoi cells.
enum class CellKind { by_shape, voronoi, quads };
/// How displacements add up: totals from the reference shape in a frame that turns with the block |
/// increments on the current shape, Eq. (12).
enum class Kinematics { corotational, incremental };
/// The time scheme.
enum class Scheme {
  decaying,  ///< momenta kept exactly, motion of rigid blocks of second order, deformation and contact
             ///< as by backward Euler: vibrations decay
  central_difference,  ///< written "explicit": the decaying one with elastic forces of the start of a step,
                       ///< stable below a critical step: vibrations go on
  midpoint,            ///< momenta and energy kept exactly
  dda,                 ///< Newmark (1/2, 1), Eq. (24)-(27)
  newmark,             ///< Newmark (beta, gamma)
  backward_euler
};
/// How contact states are found: augmented Lagrangian method | Shi's open-close iteration.
enum class ContactMethod { staged, classic };

/// Schemes whose forces belong to a frame that turns with its block.
constexpr bool needs_corotational(Scheme scheme) {
  return scheme == Scheme::midpoint || scheme == Scheme::decaying || scheme == Scheme::central_difference;
}

/// Values that a preset chooses where nothing is said: for scenes and for the library alike.
struct Defaults {
  Kinematics kinematics;
  Scheme scheme;
  GradientCorrection gradient_correction;
  double cutting_factor;  ///< see AnalysisOptions
  BlockModel block_model;
  ContactMethod method;
  double penetration_tolerance;  ///< see ContactOptions
};
/// Defaults of Preset::standard.
inline constexpr Defaults standard_defaults{.kinematics = Kinematics::corotational,
                                            .scheme = Scheme::decaying,
                                            .gradient_correction = GradientCorrection::on,
                                            .cutting_factor = 0.5,
                                            .block_model = BlockModel::automatic,
                                            .method = ContactMethod::staged,
                                            .penetration_tolerance = 1e-6};
/// Defaults of Preset::paper.
inline constexpr Defaults paper_defaults{.kinematics = Kinematics::incremental,
                                         .scheme = Scheme::dda,
                                         .gradient_correction = GradientCorrection::off,
                                         .cutting_factor = 0.3,
                                         .block_model = BlockModel::wachspress,
                                         .method = ContactMethod::classic,
                                         .penetration_tolerance = 0};
/// Defaults of a preset.
constexpr const Defaults& defaults_of(Preset preset) {
  return preset == Preset::paper ? paper_defaults : standard_defaults;
}

/// Rayleigh damping: forces mass * M v and stiffness * K times the rate of deformation.
struct RayleighDamping {
  double mass = 0;       ///< 1/s, >= 0
  double stiffness = 0;  ///< s, >= 0

  bool operator==(const RayleighDamping&) const = default;
};

/// How the inside of a block of the model `mesh` is divided.
struct MeshOptions {
  CellKind kind = CellKind::by_shape;
  int cells = 64;          ///< approximate number, [1, 1e6]; not used with cell_size > 0
  double cell_size = 0;    ///< square root of a cell's area, m, >= 1e-3 of the block size; 0: by `cells`
  bool edge_nodes = true;  ///< false: the block's edges stay straight
  double at_contact = 0;   ///< size to which cells are divided where the block touches others, m, >= 1e-4 of
                           ///< the block size; 0: they are not

  bool operator==(const MeshOptions&) const = default;
};

/// Steps, laws of motion and defaults of the blocks.
struct AnalysisOptions {
  Preset preset = Preset::standard;
  Mode mode = Mode::dynamic;
  int steps = 0;         ///< >= 1
  double time_step = 0;  ///< largest step taken, s, > 0
  /// Largest displacement of a vertex in a step, > 0, over half the larger side of the model's box at the
  /// start.
  double max_displacement_ratio = 0.1;
  Vec2 gravity{0.0, -9.8};  ///< m/s2
  Plane plane = Plane::strain;
  BlockModel block_model = standard_defaults.block_model;
  MeshOptions mesh;  ///< of blocks that state none
  Kinematics kinematics = standard_defaults.kinematics;
  Scheme scheme = standard_defaults.scheme;
  double beta = 0.25, gamma = 0.5;  ///< of Scheme::newmark: beta >= gamma / 2, gamma in [0.5, 1000]
  RayleighDamping damping;
  GradientCorrection gradient_correction = standard_defaults.gradient_correction;
  /// Length of the trial step after a rejected one over the rejected one's, (0, 1).
  double cutting_factor = standard_defaults.cutting_factor;
  Skips skip;  ///< the same in all stages
};

/// Springs of the contacts.
struct ContactOptions {
  ContactMethod method = standard_defaults.method;
  double normal_stiffness = 0;      ///< N/m per m, > 0 once resolved; staged: where it starts
  double tangential_stiffness = 0;  ///< N/m per m, > 0 once resolved
  /// Largest penetration over the block size, >= 0; 0: plain penalty method.
  double penetration_tolerance = standard_defaults.penetration_tolerance;
  /// Radius of corners over the block size, >= 0, less than uses up an edge; 0: sharp.
  double corner_rounding = 0;
  /// Largest residual over the forces on a block, [1e-12, 1e-2]; none: see ContactSolverOptions.
  std::optional<double> tolerance = {};
};

}  // namespace ddacontact
