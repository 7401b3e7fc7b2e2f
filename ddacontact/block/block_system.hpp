/// \file The blocks of a scene with their loads and supports: everything of (13) but the contacts.
#pragma once

#include <ddacontact/block/block.hpp>
#include <ddacontact/block/bolt.hpp>
#include <ddacontact/block/rounded_corners.hpp>
#include <ddacontact/block/water_pressure.hpp>
#include <ddacontact/core/time_function.hpp>

#include <algorithm>
#include <cassert>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ddacontact {

/// A force that travels with its point.
struct PointLoad {
  MaterialPoint point;
  TimeFunction force;  ///< N per m
};
/// A pressure on an edge.
struct PressureLoad {
  int block = 0, edge = 0;
  TimeFunction pressure;  ///< its x, Pa: > 0 pushes into the block; follows the edge
};
/// An edge on which the surroundings go on: it bears the stress that they have at the start, lets waves out
/// and others in. Tractions Z (2 v_in - v) besides those of the stress, Z = density times the speed of
/// pressure waves normal to the edge and of shear waves along it.
struct QuietFace {
  int block = 0, edge = 0;
  Tensors stress;         ///< xx, yy, xy of the surroundings at its two ends, linear between them, Pa
  TimeFunction incoming;  ///< velocity of the wave that comes in, m/s
};
/// Water at rest on faces.
struct WaterLoad {
  Water water;
  std::vector<WetFace> faces;  ///< all that it may reach
};
/// A force on every part of a block.
struct BodyLoad {
  int block = 0;
  TimeFunction force;  ///< N/m3 of the undeformed block
};

/// Forces that decrease linearly to nothing: of blocks that were taken out on those that stay.
struct FadingForces {
  VectorXd forces{};        ///< on all unknowns; empty: none
  double from = 0, to = 0;  ///< s

  double part_left(const TimeSpan& span) const {
    return forces.size() == 0 ? 0 : std::clamp((to - span.middle()) / (to - from), 0.0, 1.0);
  }
};

/// A displacement prescribed by leaving its unknown out of the equations. The unknown is the displacement of
/// a point along an axis.
struct PrescribedDof {
  int unknown = 0;
  int vertex = 0;       ///< in the arrays of the state
  int axis = 0;         ///< 0: x, 1: y
  TimeFunction motion;  ///< total displacement since the start, or since its block came in, m

  bool moves() const { return motion.is_history() || !motion.value.isZero(0); }
};

/// A vertex of a six-unknown block held as Shi does it: by stiff springs to where it should be.
struct FixedVertex {
  int block = 0, vertex = 0;  ///< vertex of the block, 0 .. n_vertices - 1
  bool x = true, y = true;
  TimeFunction motion;
};

/// Actions on blocks, by the blocks' numbers: all but water and prescribed degrees of freedom.
struct BlockActions {
  std::vector<PointLoad> point_loads;
  std::vector<PressureLoad> pressure_loads;
  std::vector<BodyLoad> body_loads;
  std::vector<QuietFace> quiet_faces;
  std::vector<FixedVertex> fixed_vertices;

  /// Calls visit(list, the same of `other`) for all of them.
  void for_lists(auto& other, const auto& visit) {
    visit(point_loads, other.point_loads);
    visit(pressure_loads, other.pressure_loads);
    visit(body_loads, other.body_loads);
    visit(quiet_faces, other.quiet_faces);
    visit(fixed_vertices, other.fixed_vertices);
  }
  /// The block that one of them acts on.
  static int& block_of(PointLoad& load) { return load.point.block; }
  static int& block_of(auto& action) { return action.block; }
};

/// Owns the blocks; their unknowns, points and integration points are numbered in block order.
class BlockSystem : public BlockActions {
 public:
  /// Takes blocks and numbers them.
  explicit BlockSystem(std::vector<std::unique_ptr<Block>> blocks);

  int n_blocks() const { return static_cast<int>(blocks_.size()); }
  int n_unknowns() const { return n_unknowns_; }
  int n_stress_points() const { return n_stress_points_; }
  int n_coordinates() const { return n_coordinates_; }
  /// Incremental blocks are there until the next step, which replaces them (`reshape`).
  const Block& block(int b) const {
    assert(b >= 0 && b < n_blocks());
    return *blocks_[b];
  }
  /// All points at the start.
  Points reference() const;

  std::vector<std::string> names;  ///< of the blocks, for messages; their indices unless replaced
  Vec2 gravity{0, 0};              ///< m/s2
  double end_time = 0;             ///< of ramps, s
  WaterLoad water;
  FadingForces fading;
  std::vector<TimeFunction> ground;  ///< accelerations of what the blocks are seen from, m/s2
  /// Numbered by `set_bolts`.
  std::vector<Bolt> bolts;
  /// Every vertex that the scene holds, by its index in the arrays of the state, ascending. Of an affine
  /// block held at more than three vertices three carry the reactions of all.
  std::vector<int> supported_vertices;

  /// Contacts see corners as arcs of circles of this radius, in parts of each block's size, or of half the
  /// radius that an edge leaves room for where that is less; 0: sharp.
  void round_corners(double ratio);
  bool has_rounded_corners() const { return !rounded_.empty(); }
  const RoundedBlock& rounded(int b) const { return rounded_[b]; }
  /// Of the corners of block b where it meets another one: that of the smaller of both, held ones not counted, but
  /// no larger than its own, m.
  double corner_radius(int b, int other) const;

  /// Takes bolts and numbers what the state has of them.
  void set_bolts(std::vector<Bolt> all);

  void set_prescribed_dofs(std::vector<PrescribedDof> held);
  const std::vector<PrescribedDof>& prescribed_dofs() const { return prescribed_dofs_; }
  /// The row of (13) of each unknown, -1 when it is prescribed.
  const std::vector<int>& equation() const { return equation_; }
  int n_equations() const { return n_equations_; }
  int block_of_point(int point) const {
    assert(point >= 0 && point < static_cast<int>(block_of_point_.size()));
    return block_of_point_[point];
  }
  int block_of_unknown(int unknown) const;
  /// Whether a block has a free unknown.
  bool is_movable(int b) const { return movable_[b]; }
  /// Whether a block has no prescribed unknown.
  bool is_free(int b) const { return free_[b]; }
  /// Whether a block is wholly held where it is: it has neither equations nor forces of its own.
  bool is_unchanging(int b) const { return unchanging_[b]; }
  /// Whether supports hold it where it is.
  bool is_held(int b) const { return unchanging_[b] && present_[b] && !resting_[b]; }
  /// Whether the matrices of a block are computed: it may change, or it is fixed and `compute_fixed` asks.
  bool has_matrices(int b) const {
    return !unchanging_[b] || (computes_fixed_ && present_[b] && !resting_[b]);
  }
  /// Whether blocks that are wholly held where they are have matrices like all others, although these have no
  /// equations; not unless this says so. To be called before a StepSystem is made.
  void compute_fixed(bool all) { computes_fixed_ = all; }

  /// All blocks at rest and free of stress in their reference positions; prescribed points at their start;
  /// bolts not installed.
  BlockState initial_state() const;
  /// Takes a block out with its loads and supports and the bolts in it: nothing of it counts any more. Its
  /// points stay in the arrays of the state.
  void remove(int b);
  /// A block that was taken out is there again, with what was taken out with it but the water on it. Its
  /// supports move it by what they prescribe after this time, s.
  void restore(int b, double time);
  bool is_present(int b) const { return present_[b]; }
  int n_present() const { return static_cast<int>(std::ranges::count(present_, true)); }
  /// Gives the blocks that have matrices the maps and matrices of their shapes in a state, where these change
  /// with the shape (Block::reshaped).
  /// \param[in] all  blocks without matrices too
  void reshape(const BlockState& state, bool all = false);

  /// F += gravity, Eq. (23).
  void add_gravity(VectorXd& F) const;
  /// The acceleration of what the blocks are seen from, its mean over the span, m/s2.
  Vec2 ground_acceleration(const TimeSpan& span) const;
  /// Force by velocity at either end of a quiet face, N s/m per m.
  Mat2 impedance_at_ends(const QuietFace& face, const BlockState& state) const;
  using AddForce = std::function<void(int block, int vertex, const Vec2& force)>;
  /// The forces at the ends of edges of pressures, water and the surroundings, N per m, on the shape of
  /// `state`.
  void add_edge_forces(const BlockState& state, const TimeSpan& span, const AddForce& add) const;
  /// Calls visit(block, function) for the time functions of all loads and quiet faces.
  void for_load_functions(const auto& visit) const {
    for (const PointLoad& load : point_loads) visit(load.point.block, load.force);
    for (const PressureLoad& load : pressure_loads) visit(load.block, load.pressure);
    for (const BodyLoad& load : body_loads) visit(load.block, load.force);
    for (const QuietFace& face : quiet_faces) visit(face.block, face.incoming);
  }
  /// Time functions of loads, quiet faces, the ground and supports.
  std::vector<const TimeFunction*> time_functions() const;
  bool has_face_loads() const { return !pressure_loads.empty() || !water.faces.empty(); }
  /// F += point, pressure and body loads, fading forces, water and shaking on the shape of `state`, their
  /// means over the span, Eq. (21), (23).
  void add_loads(const BlockState& state, const TimeSpan& span, VectorXd& F) const;
  /// Finds the motions of the blocks that may move from their positions in `state`.
  void find_coordinates(BlockState& state) const;
  /// The step's displacements of the prescribed degrees of freedom to where they should be at `time`; 0 for
  /// all others.
  VectorXd prescribed(const BlockState& state, double time) const;

  /// All points, relative to the model's origin.
  Points positions(const BlockState& state) const;
  /// Displacements of all points, m, since the start or the last call of count_displacements_from.
  Points displacements(const BlockState& state) const;
  /// Displacement of one point along an axis since the start, m.
  double total_displacement(const BlockState& state, int point, int axis) const;
  void count_displacements_from(const BlockState& zero);
  /// The points as they were drawn, with their blocks' origins.
  const BlockState& drawn() const { return start_; }
  /// The points that displacements are counted from, with their blocks' origins.
  const BlockState& displacement_zero() const { return zero_.position.cols() > 0 ? zero_ : start_; }
  /// The outline of a block from the origin of another: no digits are lost to where they are.
  Points outline_from(const BlockState& state, int block, int origin_of) const;
  /// A vector at a material point from those at the points of all blocks.
  Vec2 interpolate(const MaterialPoint& point, const Points& at_points) const;
  /// The displacement of a material point for unknowns d, or its velocity for velocities.
  Vec2 displacement(const MaterialPoint& point, const VectorXd& d) const;

  class Part;

 private:
  /// Actions, supports and bolt nodes that were taken out with a block.
  struct TakenOut : BlockActions {
    int block = 0;
    std::vector<PrescribedDof> prescribed_dofs;
    std::vector<int> supported_vertices;
    std::vector<std::pair<std::size_t, std::size_t>> bolt_nodes;  ///< indices of bolt and node
  };

  BlockSystem() = default;
  void number_equations();
  /// Inward normal of an edge, times its length, m.
  Vec2 inward(int b, int edge, const BlockState& state) const;

  std::vector<std::unique_ptr<const Block>> blocks_;
  std::vector<RoundedBlock> rounded_;  ///< empty: corners are sharp
  BlockState start_, zero_;  ///< points and origins alone; zero_ is empty while displacements are counted
                             ///< from the start
  std::vector<int> block_of_point_;
  int n_unknowns_ = 0, n_stress_points_ = 0, n_coordinates_ = 0, n_equations_ = 0;
  std::vector<PrescribedDof> prescribed_dofs_;
  std::vector<int> equation_;
  std::vector<bool> present_;
  std::vector<TakenOut> taken_out_;
  std::vector<bool> resting_;  ///< left where they are for a while, as if wholly held
  std::vector<bool> movable_;
  std::vector<bool> free_;
  std::vector<bool> unchanging_;
  bool computes_fixed_ = false;
};

/// Best-fit rotation of a polygon against its reference, radians in (-pi, pi].
double best_fit_rotation(const PointsRef& reference, const PointsRef& outline);

}  // namespace ddacontact
