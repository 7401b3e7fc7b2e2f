/// \file The tables of a scene file as they are written: names not resolved, keys left out still left out.
///
/// The reader fills them from a file, the writer from a scene; resolve.hpp turns them into a scene.
#pragma once

#include <ddacontact/scene/problem_list.hpp>
#include <ddacontact/scene/scene.hpp>

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ddacontact::scene_format {

/// Where a table and the values of its keys stand.
class KeyLocations {
 public:
  SourceLocation table;

  void add(const char* key, SourceLocation location, bool good) {
    values_.push_back({key, std::move(location), good});
  }
  /// Makes a value that is written no good: that has been said.
  void spoil(std::string_view key) {
    for (Value& value : values_) value.good = value.good && value.key != key;
  }
  /// Written, good or not.
  bool written(std::string_view key) const { return find(key) != nullptr; }
  /// Written and of the right type, unit and range.
  bool good(std::string_view key) const {
    const Value* value = find(key);
    return value && value->good;
  }
  /// Left out, or good: a value to go on with.
  bool usable(std::string_view key) const {
    const Value* value = find(key);
    return !value || value->good;
  }
  /// Of the value; of the table when the key is left out.
  const SourceLocation& of(std::string_view key) const {
    const Value* value = find(key);
    return value ? value->location : table;
  }

 private:
  struct Value {
    const char* key;
    SourceLocation location;
    bool good;
  };
  const Value* find(std::string_view key) const {
    for (const Value& value : values_)
      if (key == value.key) return &value;
    return nullptr;
  }
  std::vector<Value> values_;
};

/// A block, material or other thing called by its name or its index.
struct Reference {
  std::string name;
  std::optional<std::int64_t> index;
};

/// A place: one of these is set, or none.
struct Place {
  std::optional<Points> inside;              ///< a polygon around it
  std::optional<Vec2> at;                    ///< a point
  std::optional<std::array<double, 4>> box;  ///< x0, y0, x1, y1 around it
};

/// Which blocks: one of its parts is set. Of a place it holds the centroids, or the point is in the block.
struct BlockSelector : Place {
  std::optional<std::string> group;
};

/// One block, or those that a selector finds.
struct BlockReference : Reference {
  std::optional<BlockSelector> selector;

  BlockReference() = default;
  BlockReference(Reference block) : Reference(std::move(block)) {}
};

/// The part of a line between two points.
struct LineSegment {
  Vec2 from{0, 0}, to{0, 0};
};

/// Which vertices or edges of a block: one of its parts is set.
struct PartSelector : Place {
  std::optional<LineSegment> on;
};

/// Vertices of a block by their indices, or those that a selector finds.
struct VertexSelection {
  std::vector<int> some;
  std::optional<PartSelector> selector;
};

/// An edge of a block by its index, or those that a selector finds.
struct EdgeSelection {
  int edge = 0;
  std::optional<PartSelector> selector{};
};

/// One name, or a list.
struct GroupNames : std::vector<std::string> {
  using std::vector<std::string>::vector;
  using std::vector<std::string>::operator=;
};

/// Copies of a block in rows, bottom up.
struct GridRecord {
  std::array<int, 2> count{1, 1};  ///< in a row, rows
  Vec2 step{0, 0};                 ///< m
  double bond = 0;                 ///< of the step, by which every other row is shifted
};

/// A block is copied at most so many times.
inline constexpr int most_copies = 1'000'000;

/// Entries (t, x, y), or (t, x): a table, or the path of a file of comma-separated values.
struct History {
  std::vector<Vec3> entries;
  int columns = 3;         ///< of an entry; 2: y is 0
  std::string file;        ///< empty: a table
  std::string unit;        ///< of plain numbers
  std::string other_unit;  ///< see Key
};

/// Stress that changes with height.
struct InitialStress {
  double level = 0;                         ///< height at which `stress` is, m
  Vec3 stress{0, 0, 0}, gradient{0, 0, 0};  ///< Pa, Pa per metre upwards
};

/// Stands for [parameters], which are put in place before keys are read.
struct Parameters {};

/// The vertices of a block with their places.
struct Outline {
  Points points;
  std::vector<SourceLocation> locations;
};

/// The joint of each edge; an empty name: that of the materials.
struct EdgeJoints {
  std::vector<Reference> joints;
};

/// `fixed`: all vertices, or some.
struct FixedVertices {
  bool all = false;
  std::vector<int> some;
};

/// A point, or the centroid.
struct Location {
  std::optional<Vec2> point;
};

/// `mesh`: the keys that are written; those of a block go before those of the analysis.
struct MeshRecord {
  std::optional<CellKind> kind;
  std::optional<int> cells;
  std::optional<double> cell_size;  ///< m; at most one of the two
  std::optional<bool> edge_nodes;
  std::optional<double> at_contact;  ///< m
  KeyLocations locations;            ///< of the keys
};

/// A block has at most as many cells.
inline constexpr int most_cells = 1'000'000;

enum class Axes { xy, x, y };
enum class Interpolation { linear, smooth };

/// Keys whose default depends on others are kept here, not in the options.
struct AnalysisRecord {
  AnalysisOptions options;
  bool in_stages = false;  ///< the stages say how many steps
  std::optional<BlockModel> block_model;
  MeshRecord mesh;
  std::optional<Kinematics> kinematics;
  std::optional<Scheme> scheme;
  std::optional<double> beta, gamma;
  std::optional<GradientCorrection> gradient_correction;
  std::optional<double> cutting_factor;
  KeyLocations locations;
};

struct ContactRecord {
  ContactOptions options;
  std::optional<ContactMethod> method;
  std::optional<double> normal_stiffness, tangential_stiffness, penetration_tolerance;
  KeyLocations locations;
};

struct MaterialRecord {
  std::string name;
  std::optional<double> density, unit_weight;
  double young = 0, poisson = 0;
  KeyLocations locations;
};

struct JointRecord {
  std::optional<std::string> name;
  Joint joint;
  std::optional<std::array<Reference, 2>> between;
  KeyLocations locations;
};

/// What a stage changes of a joint.
struct JointChange {
  Reference joint;
  std::optional<double> friction_angle, cohesion, tensile_strength, restitution, dashpot,
      residual_friction_angle;
  std::optional<bool> glued;
  KeyLocations locations;
};

/// A number of a joint's law and what changes it.
struct JointNumber {
  double Joint::*of_joint;
  std::optional<double> JointChange::*of_change;
};
inline constexpr JointNumber joint_law[]{{&Joint::friction_angle, &JointChange::friction_angle},
                                         {&Joint::cohesion, &JointChange::cohesion},
                                         {&Joint::tensile_strength, &JointChange::tensile_strength},
                                         {&Joint::dashpot, &JointChange::dashpot}};

struct BlockRecord {
  std::optional<std::string> name;
  Reference material;  ///< a geometry file may leave it out: the first
  Outline vertices;
  std::optional<EdgeJoints> edge_joints;
  GroupNames groups;
  std::optional<GridRecord> grid;
  std::optional<BlockModel> model;
  std::optional<MeshRecord> mesh;
  FixedVertices fixed;
  Vec2 velocity{0, 0};
  double angular_velocity = 0;
  Vec3 stress{0, 0, 0}, stress_gradient{0, 0, 0};
  std::string origin;  ///< of a geometry file: "feature 7"; empty for a [[block]]
  KeyLocations locations;
};

struct SupportRecord {
  BlockReference block;
  VertexSelection vertices;
  Axes axes = Axes::xy;
  std::optional<Vec2> displacement, velocity;
  std::optional<History> history, velocity_history, acceleration_history;
  std::optional<Interpolation> interpolation;
  KeyLocations locations;
};

struct LoadRecord {
  std::optional<std::string> name;
  Load::Kind type = Load::Kind::point;
  BlockReference block;
  std::optional<Vec2> at;
  std::optional<EdgeSelection> edge;
  std::optional<double> value;
  std::optional<Vec2> force;
  std::optional<History> history;
  std::optional<double> ramp;
  KeyLocations locations;
};

struct QuietRecord {
  LineSegment on;
  std::vector<QuietBoundary::Face> faces;  ///< that lie on it, once they are looked for
  std::optional<History> incoming;
  KeyLocations locations;
};

struct QuakeRecord {
  History acceleration;
  double scale = 1;
  KeyLocations locations;
};

struct BoltRecord {
  std::string name;
  Outline points;
  RockBolt bolt;
  std::optional<double> bond_stiffness;
  KeyLocations locations;
};

struct MonitorRecord {
  std::string name;
  BlockReference block;
  std::optional<Location> at;
  std::optional<int> vertex;
  KeyLocations locations;
};

/// Blocks with the locations of their names.
struct BlockList {
  std::vector<BlockReference> blocks;
  std::vector<SourceLocation> locations;
};

/// A table inside another one.
struct InnerTable {
  KeyLocations locations;
};
template <class T>
concept Inner = std::derived_from<T, InnerTable>;

/// [water]; in a stage what is different of it.
struct WaterRecord : InnerTable {
  std::optional<Outline> table, joint_table;
  std::optional<double> density;
  std::optional<bool> joints;
};

/// Keys left out stay as the analysis has them.
struct StageRecord {
  std::optional<std::string> name;
  std::optional<Mode> mode;
  int steps = 0;
  std::optional<double> time_step, max_displacement_ratio;
  std::optional<Vec2> gravity;
  std::optional<Scheme> scheme;
  std::optional<double> beta, gamma;
  std::optional<RayleighDamping> damping;
  std::optional<double> cutting_factor;
  std::vector<JointChange> joints;
  bool reset_displacements = false;
  BlockList remove;
  std::optional<int> relax;
  BlockList add;  ///< and names of bolts and loads
  std::optional<RestCriterion> until;
  std::optional<WaterRecord> water;
  KeyLocations locations;
};

struct SolverRecord {
  Skips skip;
  KeyLocations locations;
};

struct OutputRecord {
  OutputOptions options;
  KeyLocations locations;
};

/// `boundary`: corners, or a file.
struct Boundary {
  Outline outline;
  std::string file;  ///< empty: the corners
};

struct SliverRecord : InnerTable {
  polyfem::SliverLimits limits;
  SliverPolicy policy = SliverPolicy::merge;
};

struct JointSetRecord : InnerTable {
  std::optional<Reference> joint;
  JointSet set;
  std::optional<std::string> inside;
};

struct TraceRecord : InnerTable {
  std::optional<Reference> joint;
  Outline points;
};

struct VoronoiRecord : InnerTable {
  std::optional<Reference> joint;
  std::optional<std::string> inside;
  int cells = 0;
};

struct RegionRecord : InnerTable {
  std::string name;
  Outline polygon;
  bool cut = false;
  std::optional<Reference> joint, material;
  std::optional<BlockModel> model;
  std::optional<bool> fixed;
  std::optional<std::string> group;
};

struct CircleRecord : InnerTable {
  Vec2 centre{0, 0};
  double radius = 0;
  int edges = 24;
};

struct HorseshoeRecord : InnerTable {
  Vec2 floor{0, 0};
  double width = 0, height = 0;
  int edges = 12;
};

struct OpeningRecord : InnerTable {
  std::string name;
  std::optional<Outline> polygon;
  std::optional<CircleRecord> circle;
  std::optional<HorseshoeRecord> horseshoe;
  std::optional<Reference> joint;
  bool excavated = false;
};

enum class TVertices { drop, keep };

struct DomainRecord {
  Boundary boundary;
  std::optional<Reference> material;
  int seed = 1;
  std::optional<SliverRecord> sliver;
  TVertices t_vertices = TVertices::drop;
  std::optional<double> snap;
  std::vector<JointSetRecord> joint_sets;
  std::vector<TraceRecord> traces;
  std::vector<VoronoiRecord> voronoi;
  std::vector<RegionRecord> regions;
  std::vector<OpeningRecord> openings;
  KeyLocations locations;
};

struct Document {
  int format = 1;
  std::string title;
  Parameters parameters;
  std::optional<std::string> geometry_file;  ///< key 'blocks'
  std::optional<double> snap;
  std::optional<SnapCounts> snapped;  ///< once vertices have moved
  std::optional<InitialStress> initial_stress;
  AnalysisRecord analysis;
  ContactRecord contact;
  std::vector<MaterialRecord> materials;
  std::vector<JointRecord> joints;
  std::vector<BlockRecord> blocks;  ///< those of the geometry file after those of the scene
  std::optional<DomainRecord> domain;
  std::optional<DomainCounts> domain_counts;  ///< once it is cut
  bool has_all_blocks = true;                 ///< false when the geometry file could not be read to its end
  std::vector<SupportRecord> supports;
  std::vector<LoadRecord> loads;
  std::optional<WaterRecord> water;
  std::vector<QuakeRecord> quakes;
  std::vector<QuietRecord> quiet_boundaries;
  std::vector<BoltRecord> bolts;
  std::vector<MonitorRecord> monitors;
  std::vector<StageRecord> stages;
  bool goes_on = false;  ///< as the next stage of a run: forces are there at its start
  SolverRecord solver;
  OutputRecord output;
  KeyLocations locations;
};

}  // namespace ddacontact::scene_format
