#include <ddacontact/solver/tangent_operator.hpp>

#include <ddacontact/solver/small_product.hpp>

namespace ddacontact {

TangentOperator::TangentOperator(FrictionProblem& problem, const std::vector<ContactTerm>& contacts,
                                 const std::vector<unsigned char>& active,
                                 const std::vector<Coupling>& couplings)
    : problem_(problem) {
  springs_.reserve(contacts.size() + couplings.size());
  entries_.reserve(AffineForm::capacity * springs_.capacity());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (active[c] & all_act)
      add(contacts[c].gap, contacts[c].slip, active[c] & normal_acts ? contacts[c].normal_stiffness : 0,
          active[c] & shear_acts ? contacts[c].tangential_stiffness : 0, 0);
  for (const Coupling& coupling : couplings) add(*coupling.column, *coupling.row, 0, 0, coupling.rate);
}

void TangentOperator::add(const AffineForm& gap, const AffineForm& slip, double normal, double shear,
                          double mixed) {
  for (std::size_t k = 0; k < gap.unknowns().size(); ++k) {
    const int u = gap.unknowns()[k];
    if (problem_.equation()[u] < 0) continue;
    entries_.push_back(
        {u, gap.coefficients()[k], k < slip.coefficients().size() ? slip.coefficients()[k] : 0});
  }
  springs_.push_back({static_cast<int>(entries_.size()), normal, shear, mixed});
}

void TangentOperator::multiply(const VectorXd& x, VectorXd& y) const {
  y.setZero(x.size());
  for (int e = 0; e < problem_.unknowns().n_elements(); ++e)
    add_product(problem_.elements()[e], problem_.unknowns().rows_of(e), x, y);
  int k = 0;
  for (const Springs& springs : springs_) {
    double a = 0, b = 0;
    for (int l = k; l < springs.end; ++l) {
      const Entry& entry = entries_[l];
      a += entry.a * x[entry.unknown];
      b += entry.b * x[entry.unknown];
    }
    const double along_a = springs.normal * a, along_b = springs.shear * b + springs.mixed * a;
    for (; k < springs.end; ++k) {
      const Entry& entry = entries_[k];
      y[entry.unknown] += along_a * entry.a + along_b * entry.b;
    }
  }
  const std::vector<int>& equation = problem_.equation();
  for (std::size_t u = 0; u < equation.size(); ++u)
    if (equation[u] < 0) y[u] = 0;
}

}  // namespace ddacontact
