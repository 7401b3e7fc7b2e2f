#include <ddacontact/equations/bolt_law.hpp>

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/solver/line_search.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

namespace {

/// Newton's method ends where no spring changes between its bound and its line; after so many solutions in
/// any case.
constexpr int most_solutions = 200;

/// The bar with its slips.
struct Bar {
  const Bolt& bolt;
  const BoltNumbers& numbers;
  const VectorXd& elongation;
  int n_segments = bolt.n_segments(), n_slips = bolt.is_grouted() ? n_segments + 1 : 0;
  VectorXd start = VectorXd::NullaryExpr(n_slips,
                                         [this](Index i) { return numbers[bolt.slip(static_cast<int>(i))]; }),
           slip = start;
  std::vector<ClippedSpring> springs{};  ///< of segments, then of bonds; their force is -N and -T

  BoltForces solve() {
    evaluate();
    for (int solutions = 0; n_slips > 0 && solutions < most_solutions; ++solutions)
      if (!improve()) break;
    return forces();
  }

  ClippedSpring segment_spring(int k) const {
    if (!bolt.has_segment(k) || numbers[Bolt::torn(k)] != 0) return {};
    const double stiffness = bolt.stiffness / numbers[Bolt::length(k)];
    return {-stiffness * (stretch(k) - numbers[Bolt::plastic(k)]), stiffness, -bolt.yield,
            std::min(bolt.yield, bolt.buckling)};
  }
  double stretch(int k) const { return elongation[k] + (n_slips > 0 ? slip[k + 1] - slip[k] : 0); }
  double bond_stiffness(int i) const { return bolt.bond_stiffness * bolt.bonded[i]; }
  ClippedSpring bond_spring(int i) const {
    const double most = bolt.bond_strength * bolt.bonded[i];
    return {-bond_stiffness(i) * (slip[i] - numbers[bolt.plastic_slip(i)]), bond_stiffness(i), -most, most};
  }
  /// Where all bonds slip the bar stays where it was: by a spring that only shows there.
  double regularization(int i) const {
    return std::sqrt(std::numeric_limits<double>::epsilon()) * bond_stiffness(i);
  }

  void evaluate() {
    springs.clear();
    for (int k = 0; k < n_segments; ++k) springs.push_back(segment_spring(k));
    for (int i = 0; i < n_slips; ++i) springs.push_back(bond_spring(i));
  }
  std::vector<int> pieces() const {
    std::vector<int> found;
    for (const ClippedSpring& of : springs) found.push_back(of.acts() ? 0 : of.force > 0 ? 1 : -1);
    return found;
  }
  double force(int spring) const { return -springs[spring].clipped(); }
  double stiffness(int spring) const { return springs[spring].acts() ? springs[spring].stiffness : 0; }

  /// Derivatives by the slips: of the potential, and of its gradient.
  VectorXd gradient() const {
    VectorXd g(n_slips);
    for (int i = 0; i < n_slips; ++i) g[i] = force(n_segments + i) + regularization(i) * (slip[i] - start[i]);
    for (int k = 0; k < n_segments; ++k) {
      g[k] -= force(k);
      g[k + 1] += force(k);
    }
    return g;
  }
  /// The inverse of the second derivative, which is tridiagonal, times the columns of b.
  MatrixXd solve_for_slips(MatrixXd b) const {
    VectorXd pivot(n_slips);
    for (int i = 0; i < n_slips; ++i) {
      pivot[i] = stiffness(n_segments + i) + regularization(i);
      for (int k : {i - 1, i})
        if (k >= 0 && k < n_segments) pivot[i] += stiffness(k);
      if (i == 0) continue;
      const double factor = stiffness(i - 1) / pivot[i - 1];
      pivot[i] -= factor * stiffness(i - 1);
      b.row(i) += factor * b.row(i - 1);
    }
    for (int i = n_slips - 1; i >= 0; --i) {
      if (i < n_segments) b.row(i) += stiffness(i) * b.row(i + 1);
      b.row(i) /= pivot[i];
    }
    return b;
  }

  /// A step of Newton's method, as far as the potential falls. False: it has led to the minimum.
  bool improve() {
    const VectorXd step = solve_for_slips(-gradient()), from = slip;
    const std::vector<int> before = pieces();
    slip += step;
    const std::vector<ClippedSpring> springs_before = springs;
    evaluate();
    if (pieces() == before) return false;
    std::vector<LineSpring> along;
    for (int k = 0; k < n_segments; ++k)
      if (springs_before[k].stiffness > 0) along.push_back({springs_before[k], step[k + 1] - step[k]});
    double slope = 0, bend = 0;
    for (int i = 0; i < n_slips; ++i) {
      along.push_back({springs_before[n_segments + i], step[i]});
      slope += regularization(i) * (from[i] - start[i]) * step[i];
      bend += regularization(i) * step[i] * step[i];
    }
    slip = from + minimum_along(along, slope, bend) * step;
    evaluate();
    return true;
  }

  BoltForces forces() const {
    BoltForces forces;
    forces.axial = VectorXd::NullaryExpr(n_segments, [&](int k) { return force(k); });
    forces.stretch = VectorXd::NullaryExpr(n_segments, [&](int k) { return stretch(k); });
    forces.slip = slip;
    forces.bond = VectorXd::NullaryExpr(n_slips, [&](int i) { return force(n_segments + i); });
    const VectorXd of_segments = VectorXd::NullaryExpr(n_segments, [&](int k) { return stiffness(k); });
    assert(!((forces.axial.array().abs() > bolt.yield).any()));
    for (int k = 0; k < n_segments && bolt.buckling < bolt.yield; ++k)
      if (const ClippedSpring& s = springs[k];
          s.force > bolt.buckling)  // what it has given way by, elastically
        forces.stored += bolt.buckling * (s.force - bolt.buckling) / s.stiffness;
    for (std::size_t k = 0; k < springs.size(); ++k)
      if (springs[k].stiffness > 0)
        forces.stored += force(static_cast<int>(k)) * force(static_cast<int>(k)) / (2 * springs[k].stiffness);
    forces.stiffness = of_segments.asDiagonal();
    if (n_slips == 0) return forces;
    MatrixXd by_elongations = MatrixXd::Zero(n_slips, n_segments);
    for (int k = 0; k < n_segments; ++k) {
      by_elongations(k, k) = of_segments[k];
      by_elongations(k + 1, k) = -of_segments[k];
    }
    const MatrixXd slips = solve_for_slips(by_elongations);
    forces.stiffness += of_segments.asDiagonal() * (slips.bottomRows(n_segments) - slips.topRows(n_segments));
    return forces;
  }
};

/// Keeps what has yielded and where the bar is. Returns what yielding takes.
double keep_plastic(const Bolt& bolt, const BoltForces& forces, VectorOut numbers) {
  double dissipated = 0;
  const auto keep = [&](int place, double plastic, double force) {
    dissipated += force * (plastic - numbers[place]);
    numbers[place] = plastic;
  };
  for (int k = 0; k < bolt.n_segments(); ++k) {
    if (std::abs(forces.axial[k]) < bolt.yield || forces.axial[k] == 0) continue;
    keep(Bolt::plastic(k), forces.stretch[k] - forces.axial[k] * numbers[Bolt::length(k)] / bolt.stiffness,
         forces.axial[k]);
  }
  for (int i = 0; i < forces.slip.size(); ++i) {
    numbers[bolt.slip(i)] = forces.slip[i];
    if (std::abs(forces.bond[i]) < bolt.bond_strength * bolt.bonded[i]) continue;
    keep(bolt.plastic_slip(i), forces.slip[i] - forces.bond[i] / (bolt.bond_stiffness * bolt.bonded[i]),
         forces.bond[i]);
  }
  return dissipated;
}

/// Tears the segments that are strained too far. False: none is.
bool tear(const Bolt& bolt, const BoltForces& forces, VectorOut numbers) {
  bool any = false;
  for (int k = 0; k < bolt.n_segments(); ++k) {
    if (!bolt.has_segment(k) || numbers[Bolt::torn(k)] != 0) continue;
    const double strain = forces.stretch[k] / numbers[Bolt::length(k)] + bolt.pretension / bolt.stiffness;
    if (strain <= bolt.rupture_strain) continue;
    numbers[Bolt::torn(k)] = 1;
    any = true;
  }
  return any;
}

}  // namespace

BoltForces bolt_forces(const Bolt& bolt, const BoltNumbers& numbers, const VectorXd& elongation) {
  return Bar{bolt, numbers, elongation}.solve();
}

BoltLosses follow(const Bolt& bolt, const VectorXd& elongation, VectorOut numbers) {
  BoltForces forces = bolt_forces(bolt, numbers, elongation);
  BoltLosses losses{keep_plastic(bolt, forces, numbers)};
  const double stored = forces.stored;
  while (tear(bolt, forces, numbers)) {
    losses.tears = true;
    forces = bolt_forces(bolt, numbers, elongation);
    keep_plastic(bolt, forces, numbers);
  }
  losses.dissipated += stored - forces.stored;
  return losses;
}

double bolt_energy(const BlockSystem& blocks, const BlockState& state) {
  double energy = 0;
  for (const Bolt& bolt : blocks.bolts)
    if (acts(bolt, blocks))
      energy += bolt_forces(bolt, bolt.numbers.of(state.bolts), elongations(bolt, blocks, state)).stored;
  return energy;
}

}  // namespace ddacontact
