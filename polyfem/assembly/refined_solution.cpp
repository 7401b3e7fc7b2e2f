#include <polyfem/assembly/refined_solution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace polyfem {
namespace {

/// Of K, not of its lower triangle alone.
int longest_row(const SparseMatrix& lower) {
  std::vector<int> length(static_cast<std::size_t>(lower.cols()), 0);
  for (int c = 0; c < lower.cols(); ++c) {
    length[c] += lower.outerIndexPtr()[c + 1] - lower.outerIndexPtr()[c];
    for (int slot = lower.outerIndexPtr()[c] + 1; slot < lower.outerIndexPtr()[c + 1]; ++slot)
      ++length[lower.innerIndexPtr()[slot]];
  }
  return length.empty() ? 0 : *std::max_element(length.begin(), length.end());
}

/// b - K x in `left`; returns the largest of its entries over the sum of the sizes of what it is made of.
double residual(const SparseMatrix& lower, const VectorXd& x, const VectorXd& b, VectorXd& left,
                VectorXd& sizes) {
  left = b;
  sizes = b.cwiseAbs();
  const int *const outer = lower.outerIndexPtr(), *const row = lower.innerIndexPtr();
  const double* const value = lower.valuePtr();
  for (int c = 0; c < lower.cols(); ++c) {
    const double own = x[c];
    double sum = value[outer[c]] * own, size = std::abs(sum);  // the diagonal comes first
    for (int slot = outer[c] + 1; slot < outer[c + 1]; ++slot) {
      const double down = value[slot] * own, across = value[slot] * x[row[slot]];
      left[row[slot]] -= down;
      sizes[row[slot]] += std::abs(down);
      sum += across;
      size += std::abs(across);
    }
    left[c] -= sum;
    sizes[c] += size;
  }
  double worst = 0;
  for (Index k = 0; k < left.size(); ++k)
    if (left[k] != 0) worst = std::max(worst, std::abs(left[k]) / sizes[k]);
  return worst;
}

}  // namespace

bool refined_solution(const SparseMatrix& lower, Cholesky& rough, const VectorXd& b, VectorXd& x) {
  constexpr double least_gain = 10;
  // Of x, and of each sum that a residual is made of: what is below this is not known.
  const double round_off = (longest_row(lower) + 2) * std::numeric_limits<double>::epsilon() / 2;
  VectorXd left = b, sizes, step;
  x.setZero(b.size());
  double error = std::numeric_limits<double>::infinity();
  while (true) {
    rough.solve_roughly(left, step);
    x += step;
    const double before = error;
    error = residual(lower, x, b, left, sizes);
    if (error <= round_off) return true;
    if (!(error * least_gain <= before)) return false;
  }
}

}  // namespace polyfem
