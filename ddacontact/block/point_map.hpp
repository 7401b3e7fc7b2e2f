/// \file Points of blocks, and their displacements as linear maps of the blocks' unknowns.
#pragma once

#include <ddacontact/core/affine_form.hpp>

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

namespace ddacontact {

/// A point that travels with its block: x = sum_p weights[p] * (point p of the block).
struct MaterialPoint {
  int block = 0;
  VectorXd weights;  ///< see Block::point_weights
};

/// u = sum_k columns[k] d[unknowns[k]]. All that contact and loads know of a block's unknowns. Of a point
/// that has unknowns of its own, u = (d[first], d[first + 1]), that is all it keeps; else it refers to terms
/// that its block keeps.
class PointMap {
 public:
  static constexpr int capacity = 6;

  /// column * d[first + unknown]
  struct Term {
    int unknown;
    Vec2 column;
  };

  /// A point that does not move.
  PointMap() = default;
  /// A point whose displacement are the unknowns `first` and `first` + 1.
  explicit PointMap(int first) : first_(first), size_(2) {}
  /// A point moved by the terms, their columns times d[first + unknown]; valid while the terms are.
  PointMap(int first, std::span<const Term> terms)
      : terms_(terms.data()), first_(first), size_(static_cast<int>(terms.size())) {
    assert(size_ <= capacity);
  }

  /// Whether the displacement are two unknowns of its own, `first_unknown` and the next.
  bool is_own() const { return size_ == 2 && !terms_; }
  int first_unknown() const { return first_; }

  /// Calls visit(unknown, column).
  void for_terms(const auto& visit) const {
    if (is_own()) {
      visit(first_, Vec2::UnitX());
      visit(first_ + 1, Vec2::UnitY());
    }
    for (const Term& term : terms()) visit(first_ + term.unknown, term.column);
  }
  /// The displacement, or the velocity when given velocities.
  Vec2 operator()(const VectorXd& d) const {
    if (is_own()) return d.segment<2>(first_);
    Vec2 u = Vec2::Zero();
    for (const Term& term : terms()) u += d[first_ + term.unknown] * term.column;
    return u;
  }
  /// F += map^T force: a force acting on the point, Eq. (21).
  void add_force(const Vec2& force, VectorXd& F) const {
    if (is_own()) F.segment<2>(first_) += force;
    for (const Term& term : terms()) F[first_ + term.unknown] += term.column.dot(force);
  }
  /// form += direction . u
  void add_to(AffineForm& form, const Vec2& direction) const {
    for_terms([&](int unknown, const Vec2& column) { form.add(unknown, direction.dot(column)); });
  }

 private:
  std::span<const Term> terms() const { return {terms_, terms_ ? static_cast<std::size_t>(size_) : 0}; }

  const Term* terms_ = nullptr;
  int first_ = 0, size_ = 0;
};

/// terms += column * d[unknown], merged with an earlier one of the same unknown.
inline void add_term(int unknown, const Vec2& column, std::vector<PointMap::Term>& terms) {
  const auto same =
      std::ranges::find_if(terms, [&](const PointMap::Term& term) { return term.unknown == unknown; });
  if (same == terms.end())
    terms.push_back({unknown, column});
  else
    same->column += column;
}

}  // namespace ddacontact
