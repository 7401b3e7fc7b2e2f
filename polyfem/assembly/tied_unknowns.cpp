#include <polyfem/assembly/tied_unknowns.hpp>

#include <polyfem/core/error.hpp>

#include <string>

namespace polyfem {
namespace {

/// An unknown by those that follow nothing.
struct Resolved {
  std::map<int, double> factors;
  double constant = 0;
  bool done = false;
};

class Resolver {
 public:
  explicit Resolver(const std::map<int, TiedUnknowns::Tie>& ties) : ties_(ties) {}

  const Resolved& resolve(int unknown) {
    const auto [slot, is_new] = resolved_.try_emplace(unknown);
    Resolved& resolved = slot->second;  // stays where it is while others are added
    if (resolved.done) return resolved;
    if (!is_new)
      throw Error("unknown " + std::to_string(unknown) +
                  " is tied to itself, by others or directly: leave one of the ties out");
    const TiedUnknowns::Tie& tie = ties_.at(unknown);
    resolved.constant = tie.constant;
    for (const auto& [other, factor] : tie.terms) {
      if (!ties_.contains(other)) {
        resolved.factors[other] += factor;
        continue;
      }
      const Resolved& of_other = resolve(other);
      resolved.constant += factor * of_other.constant;
      for (const auto& [master, of_master] : of_other.factors) resolved.factors[master] += factor * of_master;
    }
    resolved.done = true;
    return resolved;
  }

 private:
  const std::map<int, TiedUnknowns::Tie>& ties_;
  std::map<int, Resolved> resolved_;
};

}  // namespace

Reduction TiedUnknowns::reduce(const PrescribedDofs& prescribed, int n_unknowns) const {
  std::vector<int> column(static_cast<std::size_t>(n_unknowns), -1);
  int n_columns = 0;
  for (int k = 0; k < n_unknowns; ++k)
    if (!is_tied(k) && !prescribed.is_prescribed(k)) column[static_cast<std::size_t>(k)] = n_columns++;

  Reduction reduction{SparseMatrix(n_unknowns, n_columns), VectorXd::Zero(n_unknowns)};
  prescribed.set_values(reduction.g);
  std::vector<Eigen::Triplet<double, int>> entries;
  const VectorXd prescribed_values = reduction.g;
  Resolver resolver(ties_);
  for (int k = 0; k < n_unknowns; ++k) {
    if (const int own = column[static_cast<std::size_t>(k)]; own >= 0) entries.emplace_back(k, own, 1.);
    if (!is_tied(k)) continue;
    const Resolved& resolved = resolver.resolve(k);
    reduction.g[k] = resolved.constant;
    for (const auto& [master, factor] : resolved.factors) {
      if (prescribed.is_prescribed(master))
        reduction.g[k] += factor * prescribed_values[master];
      else
        entries.emplace_back(k, column[static_cast<std::size_t>(master)], factor);
    }
  }
  reduction.T.setFromTriplets(entries.begin(), entries.end());
  return reduction;
}

}  // namespace polyfem
