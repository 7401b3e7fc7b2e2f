#include "limit_analysis.hpp"

#include <polyfem/geometry/area_moments.hpp>

#include <glpk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace support {

namespace {

using ddacontact::Error;
using polyfem::cross;
using polyfem::Index;

/// Out of balance, in weights of a typical block summed over all blocks, that counts as none.
constexpr double balance_tolerance = 1e-8;

/// A velocity of a mechanism that pushes a corner into a corner by less than this part of the fastest does
/// not.
constexpr double velocity_tolerance = 1e-7;

Vec2 turned(const Vec2& vector, double angle) {
  return std::cos(angle) * vector + std::sin(angle) * Vec2(-vector.y(), vector.x());
}

/// Balance of the free blocks as rows, made dimensionless. Columns, all >= 0, are the forces along both edges
/// of every contact's cone, then what a derived program adds.
class Balance {
 public:
  explicit Balance(const RigidBlocks& blocks)
      : blocks_(blocks), problem_(glp_create_prob(), &glp_delete_prob) {
    glp_term_out(GLP_OFF);
    int row = 0;
    for (const bool fixed : blocks.fixed) {
      first_row_.push_back(fixed ? 0 : row + 1);
      if (!fixed) row += 3;
    }
    if (row > 0) glp_add_rows(problem_.get(), row);
    for_each_row([&](int r, int block, int component) {
      glp_set_row_bnds(problem_.get(), r, GLP_FX, -scaled(blocks.dead, block, component), 0);
    });
    for (const ContactPoint& point : blocks.touching.points) add(point);
  }

  int n_rows() const { return glp_get_num_rows(problem_.get()); }

  void set_friction(double friction) {
    angle_ = std::atan(friction);
    for (const Contact& contact : contacts_) set_forces(contact);
  }

  /// A column for what is missing in each row, in both senses, at a cost of 1.
  void add_missing_forces() {
    for (int row = 1; row <= n_rows(); ++row)
      for (const double sign : {1.0, -1.0}) set_column(add_column(1), {row}, {sign});
  }

  /// A column for the load factor, that counts as gain.
  void add_live_load() {
    std::vector<int> rows;
    std::vector<double> values;
    for_each_row([&](int row, int block, int component) {
      if (const double value = scaled(blocks_.live, block, component); value != 0) {
        rows.push_back(row);
        values.push_back(value);
      }
    });
    set_column(add_column(-1), rows, values);
  }

  /// The least cost, with tangents for the corners that need one. None: not bounded or not feasible, see
  /// `status`. Throws Error when the solver gives up.
  std::optional<double> least_cost() {
    do {
      solve();
      if (status() != GLP_OPT) return std::nullopt;
    } while (choose_tangents());
    return glp_get_obj_val(problem_.get());
  }
  int status() const { return glp_get_status(problem_.get()); }

 private:
  struct Contact {
    ContactPoint point;
    std::array<int, 2> columns;  ///< of the forces along both edges of its cone
  };

  void add(const ContactPoint& point) {
    if (first_row(point.one) == 0 && first_row(point.other) == 0) return;
    contacts_.push_back({point, {add_column(0), add_column(0)}});
    set_forces(contacts_.back());
  }

  void set_forces(const Contact& contact) {
    const ContactPoint& point = contact.point;
    for (std::size_t edge = 0; edge < 2; ++edge) {
      const Vec2 force = turned(point.normal, edge == 0 ? -angle_ : angle_);
      std::vector<int> rows;
      std::vector<double> values;
      for (const auto& [block, sign] : {std::pair(point.one, 1.0), std::pair(point.other, -1.0)}) {
        if (first_row(block) == 0) continue;
        for (int c = 0; c < 3; ++c) rows.push_back(first_row(block) + c);
        values.insert(values.end(),
                      {sign * force.x(), sign * force.y(), sign * cross(arm(block, point.at), force)});
      }
      set_column(contact.columns[edge], rows, values);
    }
  }

  void solve() {
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    options.tol_bnd = options.tol_dj = 1e-9;
    if (glp_simplex(problem_.get(), &options) == 0) return;
    glp_std_basis(problem_.get());  // the last one may be singular in columns that have changed
    if (glp_simplex(problem_.get(), &options) != 0)
      throw Error("limit analysis: the linear program was not solved");
  }

  /// A tangent for every corner that the mechanism pushes into another; false: there is none.
  bool choose_tangents() {
    double fastest = 0;
    for (int row = 1; row <= n_rows(); ++row)
      fastest = std::max(fastest, std::abs(glp_get_row_dual(problem_.get(), row)));
    bool chosen = false;
    for (const CornerContact& corner : blocks_.touching.corners) {
      const Vec2 apart = velocity(corner.one, corner.at) - velocity(corner.other, corner.at);
      const double by_first = corner.first.dot(apart), by_last = corner.last.dot(apart);
      if (std::max(by_first, by_last) >= -velocity_tolerance * fastest) continue;
      add({corner.one, corner.other, corner.at, by_first > by_last ? corner.first : corner.last});
      chosen = true;
    }
    return chosen;
  }

  /// In the mechanism, of a point of a block.
  Vec2 velocity(int block, const Vec2& at) const {
    if (first_row(block) == 0) return Vec2::Zero();
    const auto rate = [&](int c) { return -glp_get_row_dual(problem_.get(), first_row(block) + c); };
    const Vec2 from_centroid = arm(block, at);
    return {rate(0) - rate(2) * from_centroid.y(), rate(1) + rate(2) * from_centroid.x()};
  }

  int add_column(double cost) {
    const int column = glp_add_cols(problem_.get(), 1);
    glp_set_col_bnds(problem_.get(), column, GLP_LO, 0, 0);
    glp_set_obj_coef(problem_.get(), column, cost);
    return column;
  }
  void set_column(int column, std::vector<int> rows, std::vector<double> values) {
    rows.insert(rows.begin(), 0);  // the solver counts from 1
    values.insert(values.begin(), 0);
    glp_set_mat_col(problem_.get(), column, static_cast<int>(rows.size()) - 1, rows.data(), values.data());
  }
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    for (std::size_t b = 0; b < first_row_.size(); ++b)
      for (int c = 0; c < 3 && first_row_[b] > 0; ++c) visit(first_row_[b] + c, static_cast<int>(b), c);
  }
  double scaled(const BlockForces& forces, int block, int component) const {
    return forces(component, block) / (blocks_.force * (component == 2 ? blocks_.length : 1));
  }
  int first_row(int block) const { return first_row_[static_cast<std::size_t>(block)]; }
  Vec2 arm(int block, const Vec2& at) const {
    return (at - blocks_.centroids[static_cast<std::size_t>(block)]) / blocks_.length;
  }

  const RigidBlocks& blocks_;
  std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem_;
  std::vector<int> first_row_;  ///< of each block, from 1; 0: fixed
  std::vector<Contact> contacts_;
  double angle_ = 0;  ///< of friction, radians
};

bool can_be_held(Balance& with_missing_forces, double friction) {
  with_missing_forces.set_friction(friction);
  const std::optional<double> missing = with_missing_forces.least_cost();
  return missing && *missing <= balance_tolerance * with_missing_forces.n_rows();
}

}  // namespace

RigidBlocks rigid_blocks(const ddacontact::Scene& scene) {
  if (!scene.supports.empty()) throw Error("limit analysis knows no supports of single vertices");
  const auto n = static_cast<Index>(scene.blocks.size());
  RigidBlocks blocks;
  blocks.dead = blocks.live = BlockForces::Zero(3, n);
  std::vector<Points> outlines;
  std::vector<double> areas;
  double area = 0;
  for (const ddacontact::BlockDescription& of : scene.blocks) {
    if (!of.fixed && !of.fixed_vertices.empty())
      throw Error("limit analysis knows no supports of single vertices");
    outlines.push_back(polyfem::signed_area(of.vertices) > 0 ? of.vertices : of.vertices.rowwise().reverse());
    const polyfem::AreaMoments moments = polyfem::area_moments(outlines.back());
    const auto b = static_cast<Index>(areas.size());
    blocks.fixed.push_back(of.fixed);
    blocks.centroids.push_back(moments.centroid);
    areas.push_back(moments.area);
    blocks.dead.col(b).head<2>() = scene.materials[static_cast<std::size_t>(of.material)].density *
                                   moments.area * scene.analysis.gravity;
    if (of.fixed) continue;
    area += moments.area;
    blocks.force += blocks.dead.col(b).norm();
  }
  const auto n_free = static_cast<double>(std::count(blocks.fixed.begin(), blocks.fixed.end(), false));
  blocks.length = std::sqrt(area / n_free);
  blocks.force /= n_free;
  for (const ddacontact::Load& load : scene.loads) {
    const Vec2 value =
        load.force.history.empty() ? load.force.value : Vec2(load.force.history.front().tail<2>());
    switch (load.kind) {
      case ddacontact::Load::Kind::point:
        blocks.live.col(load.block).head<2>() += value;
        blocks.live(2, load.block) +=
            cross(load.at - blocks.centroids[static_cast<std::size_t>(load.block)], value);
        break;
      case ddacontact::Load::Kind::body:
        blocks.live.col(load.block).head<2>() += areas[static_cast<std::size_t>(load.block)] * value;
        break;
      case ddacontact::Load::Kind::pressure:
        throw Error("limit analysis knows no pressures");
    }
  }
  blocks.touching = touching_faces(outlines);
  return blocks;
}

RigidBlocks interlocked(RigidBlocks blocks) {
  Touching& touching = blocks.touching;
  for (const CornerContact& corner : touching.corners)
    for (const Vec2& normal : {corner.first, corner.last})
      touching.points.push_back({corner.one, corner.other, corner.at, normal});
  touching.corners.clear();
  return blocks;
}

bool can_be_held(const RigidBlocks& blocks, double friction) {
  Balance balance(blocks);
  balance.add_missing_forces();
  return can_be_held(balance, friction);
}

std::optional<double> least_friction(const RigidBlocks& blocks) {
  Balance balance(blocks);  // one for all: each solution starts from the last one's basis
  balance.add_missing_forces();
  if (can_be_held(balance, 0)) return 0;
  double low = 0, high = 89 * std::numbers::pi / 180;
  if (!can_be_held(balance, std::tan(high))) return std::nullopt;
  while (std::tan(high) - std::tan(low) > 1e-6 * std::tan(high)) {
    const double tried = (low + high) / 2;
    (can_be_held(balance, std::tan(tried)) ? high : low) = tried;
  }
  return std::tan(high);
}

std::optional<double> largest_factor(const RigidBlocks& blocks, double friction) {
  Balance balance(blocks);
  balance.set_friction(friction);
  balance.add_live_load();
  if (const std::optional<double> cost = balance.least_cost()) return -*cost;
  if (balance.status() == GLP_UNBND) return std::numeric_limits<double>::infinity();
  return std::nullopt;
}

}  // namespace support
