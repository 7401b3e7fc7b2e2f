/// \file The displacement of a point as a linear map of its block's unknowns.
#pragma once

#include <ddacontact/core/affine_form.hpp>

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

namespace ddacontact {

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
  /// Of different unknowns; valid while the terms are.
  PointMap(int first, std::span<const Term> terms)
      : terms_(terms.data()), first_(first), size_(static_cast<int>(terms.size())) {
    assert(size_ <= capacity);
  }

  /// Whether the displacement are two unknowns of its own, `first_unknown` and the next.
  bool is_own() const { return size_ == 2 && !terms_; }
  int first_unknown() const { return first_; }

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
    if (is_own()) {
      form.add(first_, direction.x());
      form.add(first_ + 1, direction.y());
    }
    for (const Term& term : terms()) form.add(first_ + term.unknown, direction.dot(term.column));
  }

 private:
  std::span<const Term> terms() const { return {terms_, terms_ ? static_cast<std::size_t>(size_) : 0}; }

  const Term* terms_ = nullptr;
  int first_ = 0, size_ = 0;
};

/// terms += column * d[unknown], merged with an earlier one of the same unknown.
inline void add_term(int unknown, const Vec2& column, std::vector<PointMap::Term>& terms) {
  const auto same = std::find_if(terms.begin(), terms.end(),
                                 [&](const PointMap::Term& term) { return term.unknown == unknown; });
  if (same == terms.end())
    terms.push_back({unknown, column});
  else
    same->column += column;
}

}  // namespace ddacontact
