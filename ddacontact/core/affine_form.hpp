/// \file An affine function of the unknowns of a step.
#pragma once

#include <ddacontact/core/types.hpp>

#include <array>
#include <cassert>
#include <span>

namespace ddacontact {

/// g(d) = constant + sum_k coefficients[k] d[unknowns[k]]: the normal gap (36) and the slip (44) of a
/// contact, for any kind of block. Never allocates; a vertex and an edge of two six-unknown blocks fill it.
class AffineForm {
 public:
  static constexpr int capacity = 12;

  double constant = 0;

  /// Adds c d[unknown], merging it with an earlier term of the same unknown.
  void add(int unknown, double c) {
    for (int k = 0; k < size_; ++k) {
      if (unknowns_[k] == unknown) {
        coefficients_[k] += c;
        return;
      }
    }
    append(unknown, c);
  }
  /// The same for an unknown that has no term yet.
  void append(int unknown, double c) {
    assert(size_ < capacity);
    unknowns_[size_] = unknown;
    coefficients_[size_++] = c;
  }

  /// The part that depends on d: the change of g over the step.
  double change(const VectorXd& d) const {
    double sum = 0;
    for (int k = 0; k < size_; ++k) sum += coefficients_[k] * d[unknowns_[k]];
    return sum;
  }
  double operator()(const VectorXd& d) const { return constant + change(d); }

  /// F += factor * gradient of g.
  void add_gradient(double factor, VectorXd& F) const {
    for (int k = 0; k < size_; ++k) F[unknowns_[k]] += factor * coefficients_[k];
  }

  /// Calls visit(unknown, coefficient).
  void for_terms(const auto& visit) const {
    for (int k = 0; k < size_; ++k) visit(unknowns_[k], coefficients_[k]);
  }
  std::span<const int> unknowns() const { return {unknowns_.data(), static_cast<std::size_t>(size_)}; }
  std::span<const double> coefficients() const {
    return {coefficients_.data(), static_cast<std::size_t>(size_)};
  }

 private:
  int size_ = 0;
  std::array<int, capacity> unknowns_;
  std::array<double, capacity> coefficients_;
};

}  // namespace ddacontact
