/// \file A scene as plain data: what a scene file says, with every default filled in and every name resolved.
///
/// SI units throughout (m, kg, s, N, Pa), thickness 1 m, y upwards, tension positive, angles in degrees,
/// counter-clockwise positive. Indices of vertices and edges are those of the scene file; edge k runs from
/// vertex k to vertex k + 1.
#pragma once

#include <ddacontact/core/options.hpp>
#include <ddacontact/core/rest_criterion.hpp>
#include <ddacontact/core/time_function.hpp>
#include <ddacontact/core/water.hpp>
#include <ddacontact/domain/domain_cutting.hpp>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ddacontact {

/// What blocks are made of: isotropic, linear elastic.
struct Material {
  std::string name;
  double density = 0;  ///< kg/m3; > 0
  double young = 0;    ///< Pa; > 0
  double poisson = 0;  ///< [0, 0.5)
};

/// Mohr-Coulomb strength of contacts, and how they take impacts.
struct Joint {
  std::string name;
  double friction_angle = 0;                  ///< degrees, [0, 90)
  double cohesion = 0;                        ///< Pa
  double tensile_strength = 0;                ///< Pa
  std::optional<std::array<int, 2>> between;  ///< materials; none: everything not named elsewhere
  std::optional<double> restitution{};        ///< 0..1, normal, of blocks that meet; none: as they deform
  double dashpot = 0;                         ///< contact damping, ratio to critical of the contact spring
  bool glued = false;                         ///< closed contacts neither open nor slide; in stages alone
  std::optional<double> residual_friction_angle{};  ///< degrees, of contacts that have slid or opened, or
                                                    ///< closed after the start; none: `friction_angle`
  std::optional<double> normal_stiffness{};         ///< Pa/m; none: rigid, as along the joint then
  std::optional<double> shear_stiffness{};          ///< Pa/m; none: rigid
  std::optional<double> dilation_angle{};           ///< degrees, of contacts that slide; none: 0
  std::optional<double> dilation_slip{};            ///< m, of the slip that dilates
  std::optional<double> compressive_strength{};     ///< Pa, of the blocks at the joint; none: unlimited
  bool ductile = false;  ///< bonds outlast slip and are lost by opening alone; in studies of safety, no key
};

/// One block as the scene states it.
struct BlockDescription {
  std::string name;  ///< empty: known by its index alone
  int material = 0;
  Points vertices;  ///< as given, either orientation
  /// The joint that contacts on each edge follow, -1: that of the materials; empty: that of the materials.
  std::vector<int> edge_joints;
  std::vector<std::string> groups;
  BlockModel model = BlockModel::wachspress;
  MeshOptions mesh;                 ///< of the model `mesh`
  bool fixed = false;               ///< every vertex held in x and y
  std::vector<int> fixed_vertices;  ///< held in x and y, when not all are
  Vec2 velocity{0, 0};              ///< initial, m/s
  double angular_velocity = 0;      ///< initial, about the centroid, rad/s
  Vec3 stress{0, 0, 0};             ///< initial (xx, yy, xy), at the centroid, Pa
  Vec3 stress_gradient{0, 0, 0};    ///< its change per metre upwards, Pa/m
};

/// Vertices of a block whose displacement is prescribed.
struct Support {
  int block = 0;
  std::vector<int> vertices;
  bool fix_x = true, fix_y = true;
  TimeFunction displacement;  ///< m
};

/// One force on a block; which members count depends on the kind.
struct Load {
  enum class Kind { point, pressure, body };
  std::string name;  ///< may be empty, and that of several
  Kind kind = Kind::point;
  int block = 0;
  Vec2 at{0, 0};       ///< point: where at the start
  int edge = 0;        ///< pressure
  TimeFunction force;  ///< point: N per m; body: N/m3; pressure: its x, Pa, > 0 pushes into the block
};

/// Shaking of the ground, which blocks are told relative to.
struct Quake {
  TimeFunction acceleration;  ///< of the ground, m/s2; 0 outside its entries
};

/// A boundary on which the surroundings go on.
struct QuietBoundary {
  /// An edge of a block.
  struct Face {
    int block = 0, edge = 0;
  };
  Vec2 from{0, 0}, to{0, 0};  ///< the line that its faces lie on, m
  std::vector<Face> faces;
  TimeFunction incoming;  ///< velocity of the wave that comes in, m/s
};

/// A steel bar that holds blocks together.
struct RockBolt {
  /// Fixed at both ends; or bonded to every block that it passes.
  enum class Kind { anchored, grouted };
  std::string name;
  Vec2 from{0, 0}, to{0, 0};  ///< where at the start of the run, m
  Kind kind = Kind::anchored;
  double area = 0;                         ///< of its section, m2
  double young = 0;                        ///< Pa
  std::optional<double> yield_force{};     ///< axial, N; none: it stays elastic
  std::optional<double> rupture_strain{};  ///< none: it does not tear
  double pretension = 0;                   ///< axial force when it is installed, N
  double bond_stiffness = 0;               ///< grouted: force per length and slip, N/m2
  std::optional<double> bond_strength{};   ///< grouted: force per length, N/m; none: the bond stays elastic
  double spacing = 1;                      ///< between such bolts along the thickness, m
};

/// A place whose motion is recorded.
struct Monitor {
  enum class Kind { point, vertex, centroid };
  std::string name;
  int block = 0;
  Kind kind = Kind::centroid;
  Vec2 at{0, 0};
  int vertex = 0;
};

/// A part of a run.
struct StageDescription {
  std::string name;                    ///< may be empty
  AnalysisOptions analysis;            ///< while it lasts; `steps` are its own
  std::vector<Joint> joints;           ///< those of the scene, in their order, as they are while it lasts
  bool reset_displacements = false;    ///< at its end displacements are counted anew; stresses stay
  std::vector<int> removed;            ///< blocks taken out at its start
  std::optional<RestCriterion> until;  ///< ends it with the first step that meets it
  Water water{};                       ///< while it lasts
  std::vector<int> bolts{};            ///< installed at its start, absent before
  std::vector<int> added{};            ///< blocks that come in at its start, absent before
  std::optional<int> relax{};          ///< steps in which forces of `removed` decrease; none: gone at once
  std::vector<int> loads{};            ///< that act from its start on
};

/// How much is written.
struct OutputOptions {
  int every = 1;  ///< a frame every k steps; 0: only the last
  std::vector<std::string> fields{"displacement", "velocity", "stress", "principal"};
  int refine = 0;
  int checkpoint_every = 0;
};

/// What making rounded blocks touch came to.
struct SnapCounts {
  int moved = 0;        ///< vertices
  double farthest = 0;  ///< of them, how far, m
};

/// Everything that a scene file says.
struct Scene {
  std::string title;
  AnalysisOptions analysis;
  ContactOptions contact;
  std::vector<Material> materials;
  std::vector<Joint> joints;  ///< the first is the default
  std::vector<BlockDescription> blocks;
  std::vector<Support> supports;
  std::vector<Load> loads;
  Water water;
  std::vector<Quake> quakes;
  std::vector<QuietBoundary> quiet_boundaries;
  std::vector<RockBolt> bolts;
  std::vector<Monitor> monitors;
  std::vector<StageDescription> stages;  ///< run in sequence; none: one part of analysis.steps
  OutputOptions output;
  std::optional<DomainCounts> domain;  ///< what cutting blocks from it came to
  std::optional<SnapCounts> snapped;   ///< where vertices moved

  /// The name of a block in every result: its own, else its index.
  std::string block_name(int block) const;
  /// A stage that changes nothing yet.
  StageDescription stage(std::string of_name) const {
    return {std::move(of_name), analysis, joints, false, {}, {}, water, {}};
  }
  /// Over all stages.
  int n_steps() const;
  double end_time() const;  ///< s
};

}  // namespace ddacontact
