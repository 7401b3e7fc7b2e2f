/// \file The displacement of a point as a linear map of its block's unknowns.
#pragma once

#include <ddacontact/core/affine_form.hpp>

#include <array>
#include <cassert>

namespace ddacontact {

/// u = sum_k columns[k] d[unknowns[k]]. All that contact and loads know of a block's unknowns.
class PointMap {
 public:
  static constexpr int capacity = 6;

  void add(int unknown, const Vec2& column) {
    for (int k = 0; k < size_; ++k) {
      if (unknowns_[k] == unknown) {
        columns_[k] += column;
        return;
      }
    }
    assert(size_ < capacity);
    unknowns_[size_] = unknown;
    columns_[size_++] = column;
  }

  /// The displacement, or the velocity when given velocities.
  Vec2 operator()(const VectorXd& d) const {
    Vec2 u = Vec2::Zero();
    for (int k = 0; k < size_; ++k) u += d[unknowns_[k]] * columns_[k];
    return u;
  }
  /// F += map^T force: a force acting on the point, Eq. (21).
  void add_force(const Vec2& force, VectorXd& F) const {
    for (int k = 0; k < size_; ++k) F[unknowns_[k]] += columns_[k].dot(force);
  }
  /// form += direction . u
  void add_to(AffineForm& form, const Vec2& direction) const {
    for (int k = 0; k < size_; ++k) form.add(unknowns_[k], direction.dot(columns_[k]));
  }

 private:
  int size_ = 0;
  std::array<int, capacity> unknowns_;
  std::array<Vec2, capacity> columns_;
};

}  // namespace ddacontact
