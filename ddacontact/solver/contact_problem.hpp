/// \file The contact problem of a step: bodies with generalized velocities, and impulses at contacts.
///
/// Find velocities z and impulses (p, q) with
///     A (z - z_free) = H_n' p + H_t' q,
///     u = H_n z + b_n,  v = H_t z + b_t,  and Coulomb's law between (u, v) and (p, q) at every contact.
/// A is block diagonal, one block a body. Solvers see this and nothing of blocks.
#pragma once

#include <ddacontact/contact/coulomb_law.hpp>
#include <ddacontact/core/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace ddacontact {

/// The contact problem of a step. Bodies and contacts are added once; impulses are what solvers change.
class ContactProblem {
 public:
  /// A body. \param[in] mass  its A: a vector, the diagonal, > 0; or a matrix, symmetric positive definite
  /// \return its number
  template <class Mass>
  int add_body(const Eigen::MatrixBase<Mass>& mass, const Eigen::Ref<const VectorXd>& free_velocity) {
    if constexpr (Mass::ColsAtCompileTime == 1)
      return add_diagonal_body(mass, free_velocity);
    else
      return add_dense_body(mass, free_velocity);
  }

  /// One side of a contact: how the velocities of its body change the rates of gap and slip.
  struct Side {
    int body = -1;                             ///< -1: what does not move
    Eigen::Ref<const VectorXd> normal, shear;  ///< of as many numbers as the body has unknowns
  };
  /// A contact of two different bodies, at least one of them not -1. It starts with no impulse.
  /// \param[in] offset  b_n and b_t, m/s
  int add_contact(const Side& one, const Side& other, const NormalAndShear& offset, const CoulombLaw& law);

  int n_bodies() const { return static_cast<int>(first_.size()) - 1; }
  int n_contacts() const { return static_cast<int>(contacts_.size()); }
  int n_unknowns() const { return first_.back(); }
  /// The first unknown of a body; of n_bodies(): n_unknowns().
  int first(int body) const { return first_[index(body)]; }
  int count(int body) const { return first_[index(body) + 1] - first_[index(body)]; }
  bool is_diagonal(int body) const { return dense_[index(body)].size() == 0; }

  std::vector<NormalAndShear> impulses;  ///< of the contacts, N s/m; in: where to start, out: the solution
  std::vector<NormalAndShear> offsets;   ///< b_n, b_t, m/s: may be changed between solutions
  /// Impulses on each body beside those of contacts that what is left over is compared with: the sum of
  /// the magnitudes of weight, loads, elastic forces and change of momentum, N s/m, >= 0.
  std::vector<double> body_scale;

  int body(int contact, int side) const { return contacts_[index(contact)].body[side]; }
  const CoulombLaw& law(int contact) const { return contacts_[index(contact)].law; }
  /// Coefficients of a side's rates by the unknowns of its body; empty where it does not move.
  std::span<const double> normal_row(int contact, int side) const { return row(contact, side, 0); }
  std::span<const double> shear_row(int contact, int side) const { return row(contact, side, 1); }
  /// A^-1 times these rows: what a unit impulse makes of the velocities of its body.
  std::span<const double> normal_response(int contact, int side) const { return row(contact, side, 2); }
  std::span<const double> shear_response(int contact, int side) const { return row(contact, side, 3); }

  const VectorXd& free_velocity() const { return free_velocity_; }
  /// y += factor A x and y += factor A^-1 x, by one body. \param[in] x, y  of the body's unknowns
  void add_mass_times(int body, const double* x, double factor, double* y) const;
  void add_response(int body, const double* x, double factor, double* y) const;
  /// The diagonal of A of a body that has no more.
  std::span<const double> diagonal(int body) const;
  const MatrixXd& dense(int body) const { return dense_[index(body)]; }

  /// z_free + A^-1 (H_n' p + H_t' q).
  VectorXd velocity() const;
  /// u and v of a contact at z.
  NormalAndShear rates(int contact, const VectorXd& z) const;
  /// What a unit impulse of a contact alone makes of its own u and of its own v, without compliance, m/s per
  /// N s/m. Of a direction in which nothing can move: a small positive number, so that it can be divided by.
  const NormalAndShear& response(int contact) const { return response_[index(contact)]; }
  /// What its unit normal impulse makes of its v, and its unit shear impulse of its u.
  double cross_response(int contact) const { return cross_response_[index(contact)]; }

  /// The problem of some of the bodies and contacts, numbered in their order. What the contacts touch has to
  /// be among the bodies.
  ContactProblem part(std::span<const int> bodies, std::span<const int> contacts) const;

 private:
  struct Contact {
    int body[2];
    std::size_t first_coefficient;  ///< of each side: normal and shear row, A^-1 times them
    CoulombLaw law;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::span<const double> row(int contact, int side, int which) const;
  int add_diagonal_body(const VectorXd& mass, const Eigen::Ref<const VectorXd>& free_velocity);
  int add_dense_body(const MatrixXd& mass, const Eigen::Ref<const VectorXd>& free_velocity);
  void append_body(const VectorXd& mass, MatrixXd dense, MatrixXd inverse,
                   const Eigen::Ref<const VectorXd>& free_velocity);
  void append_side(const Side& side);

  std::vector<int> first_{0};
  std::vector<double> diagonal_;           ///< of all unknowns; those of dense bodies are not used
  std::vector<MatrixXd> dense_, inverse_;  ///< of each body; empty: diagonal
  VectorXd free_velocity_;
  std::vector<Contact> contacts_;
  std::vector<double> coefficients_;
  std::vector<NormalAndShear> response_;
  std::vector<double> cross_response_;
};

/// The sums of the magnitudes of the impulses on each body: body_scale and all |p| and |q|, N s/m.
std::vector<double> impulse_sums(const ContactProblem& problem);
/// The smaller of the sums of a contact's bodies.
double impulse_sum(const ContactProblem& problem, const std::vector<double>& sums, int contact);

/// How far a contact problem's impulses are from solving it: the largest natural residual of a contact, as an
/// impulse, over the smaller of the sums of impulses on its two bodies, round-off taken off.
struct ContactResidual {
  double relative = 0;
  int contact = -1;  ///< where; -1: nothing is left
};
/// \param[in] z  velocity(), of the problem's impulses
ContactResidual residual(const ContactProblem& problem, const VectorXd& z);
/// The same of one contact. \param[in] sums  impulse_sums
double residual(const ContactProblem& problem, const VectorXd& z, const std::vector<double>& sums,
                int contact);

}  // namespace ddacontact
