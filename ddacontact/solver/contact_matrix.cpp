#include <ddacontact/solver/contact_matrix.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Of each body: itself and those that contacts connect it with, ascending.
std::vector<std::vector<int>> neighbours(const ContactProblem& problem) {
  std::vector<std::vector<int>> result(index(problem.n_bodies()));
  for (int b = 0; b < problem.n_bodies(); ++b) result[index(b)].push_back(b);
  for (int c = 0; c < problem.n_contacts(); ++c) {
    const int one = problem.body(c, 0), other = problem.body(c, 1);
    if (one < 0 || other < 0) continue;
    result[index(one)].push_back(other);
    result[index(other)].push_back(one);
  }
  for (std::vector<int>& list : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

}  // namespace

ContactMatrix::ContactMatrix(const ContactProblem& problem)
    : problem_(problem),
      scale_(problem.n_unknowns()),
      bodies_(index(problem.n_bodies())),
      contacts_(index(problem.n_contacts())) {
  constexpr int largest_dense = 200;  // unknowns: about where dense factors cost as much as sparse ones
  dense_ = problem.n_unknowns() <= largest_dense;
  for (int b = 0; b < problem.n_bodies(); ++b)
    for (int i = 0; i < problem.count(b); ++i)
      scale_[problem.first(b) + i] =
          1 / std::sqrt(problem.is_diagonal(b) ? problem.diagonal(b)[index(i)] : problem.dense(b)(i, i));
  if (dense_)
    place_densely();
  else
    place_sparsely();
}

void ContactMatrix::place_densely() {
  const std::size_t n = index(problem_.n_unknowns());
  dense_matrix_.resize(problem_.n_unknowns(), problem_.n_unknowns());
  for (int b = 0; b < problem_.n_bodies(); ++b) bodies_[index(b)] = {index(problem_.first(b)) * (n + 1), n};
  for (int c = 0; c < problem_.n_contacts(); ++c)
    for (const int row : {0, 1})
      for (const int column : {0, 1}) {
        const int i = problem_.body(c, row), j = problem_.body(c, column);
        if (i >= 0 && j >= 0)
          contacts_[index(c)][index(2 * row + column)] = {
              index(problem_.first(i)) + index(problem_.first(j)) * n, n};
      }
}

void ContactMatrix::place_sparsely() {
  const std::vector<std::vector<int>> near = neighbours(problem_);
  std::vector<int> first{0}, rows;
  std::vector<std::size_t> first_value(index(problem_.n_bodies())), length(index(problem_.n_bodies()));
  for (int b = 0; b < problem_.n_bodies(); ++b) {
    first_value[index(b)] = rows.size();
    for (int column = 0; column < problem_.count(b); ++column) {
      for (const int other : near[index(b)])
        for (int i = 0; i < problem_.count(other); ++i) rows.push_back(problem_.first(other) + i);
      first.push_back(static_cast<int>(rows.size()));
      length[index(b)] = rows.size() - index(first[first.size() - 2]);
    }
  }
  const auto place = [&](int row, int column) {
    std::size_t offset = first_value[index(column)];
    for (const int other : near[index(column)]) {
      if (other == row) break;
      offset += index(problem_.count(other));
    }
    return Place{offset, length[index(column)]};
  };
  for (int b = 0; b < problem_.n_bodies(); ++b) bodies_[index(b)] = place(b, b);
  for (int c = 0; c < problem_.n_contacts(); ++c)
    for (const int row : {0, 1})
      for (const int column : {0, 1}) {
        const int i = problem_.body(c, row), j = problem_.body(c, column);
        if (i >= 0 && j >= 0) contacts_[index(c)][index(2 * row + column)] = place(i, j);
      }
  const std::vector<double> ones(rows.size(), 1.0);
  matrix_ = Eigen::Map<const polyfem::SparseMatrix>(problem_.n_unknowns(), problem_.n_unknowns(),
                                                    static_cast<Index>(rows.size()), first.data(),
                                                    rows.data(), ones.data());
  factors_.analyze(matrix_);
}

void ContactMatrix::assemble(const std::vector<ContactStiffness>& stiffness, double* values) const {
  for (int b = 0; b < problem_.n_bodies(); ++b) {
    const Place& at = bodies_[index(b)];
    const int first = problem_.first(b), n = problem_.count(b);
    if (problem_.is_diagonal(b)) {
      for (int i = 0; i < n; ++i) values[at.first + index(i) * (at.stride + 1)] = 1;
      continue;
    }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        values[at.first + index(j) * at.stride + index(i)] =
            problem_.dense(b)(i, j) * scale_[first + i] * scale_[first + j];
  }
  std::vector<double> rows[2][2];  // scaled, of side and direction
  for (int c = 0; c < problem_.n_contacts(); ++c) {
    const auto [D_n, D_t, D_tn] = stiffness[index(c)];
    if (D_n == 0 && D_t == 0 && D_tn == 0) continue;
    for (const int side : {0, 1}) {
      const auto normal = problem_.normal_row(c, side), shear = problem_.shear_row(c, side);
      rows[side][0].resize(normal.size());
      rows[side][1].resize(normal.size());
      if (normal.empty()) continue;
      const double* const scale = scale_.data() + problem_.first(problem_.body(c, side));
      for (std::size_t i = 0; i < normal.size(); ++i) {
        rows[side][0][i] = normal[i] * scale[i];
        rows[side][1][i] = shear[i] * scale[i];
      }
    }
    for (const int row : {0, 1})
      for (const int column : {0, 1}) {
        const Place& at = contacts_[index(c)][index(2 * row + column)];
        const double *const n = rows[row][0].data(), *const t = rows[row][1].data();
        for (std::size_t j = 0; j < rows[column][0].size(); ++j) {
          const double by_n = D_n * rows[column][0][j],
                       by_t = D_t * rows[column][1][j] + D_tn * rows[column][0][j];
          double* const to = values + at.first + j * at.stride;
          for (std::size_t i = 0; i < rows[row][0].size(); ++i) to[i] += n[i] * by_n + t[i] * by_t;
        }
      }
  }
}

bool ContactMatrix::factorize(const std::vector<ContactStiffness>& stiffness) {
  if (dense_) {
    dense_matrix_.setZero();
    assemble(stiffness, dense_matrix_.data());
    dense_factors_.compute(dense_matrix_);
    return dense_factors_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0;
  }
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  assemble(stiffness, matrix_.valuePtr());
  return factors_.factorize(matrix_);
}

VectorXd ContactMatrix::solve(const VectorXd& b) {
  const VectorXd scaled = scale_.cwiseProduct(b);
  VectorXd x;
  if (dense_)
    x = dense_factors_.solve(scaled);
  else
    factors_.solve(matrix_, scaled, x);
  return scale_.cwiseProduct(x);
}

}  // namespace ddacontact
