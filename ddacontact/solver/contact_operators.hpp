/// \file H and its transpose, A and its products, of a whole contact problem.
#pragma once

#include <ddacontact/solver/contact_problem.hpp>

namespace ddacontact {

/// u = H_n z, v = H_t z: without the offsets.
void contact_rates(const ContactProblem& problem, const VectorXd& z, VectorXd& u, VectorXd& v);
/// y += H_n' p + H_t' q.
void add_impulses(const ContactProblem& problem, const VectorXd& p, const VectorXd& q, VectorXd& y);
/// A z.
VectorXd mass_times(const ContactProblem& problem, const VectorXd& z);

}  // namespace ddacontact
