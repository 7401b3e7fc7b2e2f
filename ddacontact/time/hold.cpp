#include <ddacontact/time/hold.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ddacontact {

namespace {

/// Springs against rates over the largest mass: a round leaves the inverse of this of an error, more in long
/// chains, and round-off times it.
constexpr double stiffness_factor = 1e6;
constexpr int most_rounds = 10, most_rounds_with_friction = 2;
/// A round that moves less than this part of all is the last one, and so is one that gains less than half.
constexpr double small_motion = 1e-7;
constexpr double friction_tolerance = 1e-6;

/// The movable blocks that contacts depend on, ascending.
std::vector<int> blocks_of(const BlockSystem& blocks, const std::vector<HeldContact>& contacts) {
  std::vector<char> touched(static_cast<std::size_t>(blocks.n_blocks()), 0);
  for (const HeldContact& contact : contacts)
    for (int u : contact.gap.unknowns()) touched[blocks.block_of_unknown(u)] = 1;
  std::vector<int> found;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (touched[b] && blocks.is_movable(b)) found.push_back(b);
  return found;
}

}  // namespace

Hold::Hold(const BlockSystem& blocks, const std::vector<HeldContact>& contacts)
    : blocks_(blocks),
      contacts_(contacts),
      motions_(blocks, blocks_of(blocks, contacts)),
      stiffness_(stiffness_factor * motions_.largest_mass()) {
  for (const HeldContact& contact : contacts)
    of_coefficients_.push_back(
        {motions_.rate_form(contact.gap), motions_.rate_form(contact.slip), contact.tangential});
  factorize();
}

void Hold::factorize() {
  polyfem::Connectivity elements;
  for (const HeldContact& contact : of_coefficients_) elements.append(contact.gap.unknowns());
  const int n = motions_.n_coefficients();
  polyfem::PatternMatrix matrix;
  matrix.set_connectivity(n, elements);
  matrix.set_identity();
  for (std::size_t c = 0; c < of_coefficients_.size(); ++c) {
    const HeldContact& contact = of_coefficients_[c];
    const int element = static_cast<int>(c);
    matrix.add_outer(element, stiffness_, contact.gap.coefficients());
    if (contact.tangential) matrix.add_outer(element, stiffness_, contact.slip.coefficients());
  }
  cholesky_.analyze(matrix.lower());
  if (!cholesky_.factorize(matrix.lower())) throw std::logic_error("a sum of squares is not positive");
}

Hold::Rates Hold::rates(const std::vector<HeldContact>& forms, const VectorXd& v) const {
  const auto n = static_cast<Index>(forms.size());
  Rates rates{VectorXd(n), VectorXd(n)};
  for (Index c = 0; c < n; ++c) {
    const HeldContact& form = forms[static_cast<std::size_t>(c)];
    rates.gap[c] = form.gap.change(v);
    rates.slip[c] = form.tangential ? form.slip.change(v) : 0;
  }
  return rates;
}

/// The motion q that impulses make, q = sum of gradient * impulse, while springs against what is left of the
/// rates add to the impulses in every round; normal impulses make friction along the slip. A round solves for
/// what its equation lacks, so that it also repairs what the last solution left.
VectorXd Hold::take_out(Rates& left, const std::vector<HeldFriction>& friction, Rates& impulses) const {
  const auto n = static_cast<Index>(of_coefficients_.size());
  std::vector<Coupling> couplings;
  for (std::size_t c = 0; c < friction.size(); ++c)
    if (friction[c].rate != 0)
      couplings.push_back(
          {&of_coefficients_[c].slip, &of_coefficients_[c].gap, friction[c].rate * stiffness_});
  impulses = {VectorXd::Zero(n), VectorXd::Zero(n)};
  VectorXd q = VectorXd::Zero(motions_.n_coefficients()), lacking, move;
  const auto solve = [&](const VectorXd& b, VectorXd& x) { cholesky_.solve(b, x); };
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < (friction.empty() ? most_rounds : most_rounds_with_friction); ++round) {
    lacking = -q;
    for (Index c = 0; c < n; ++c) {
      const std::size_t k = static_cast<std::size_t>(c);
      const HeldContact& form = of_coefficients_[k];
      const double normal = impulses.gap[c] - stiffness_ * left.gap[c];
      double shear = form.tangential ? impulses.slip[c] - stiffness_ * left.slip[c] : 0;
      if (!friction.empty()) shear += friction[k].rate * normal + friction[k].given;
      form.gap.add_gradient(normal, lacking);
      form.slip.add_gradient(shear, lacking);
    }
    solve_coupled(solve, couplings, lacking, friction_tolerance, move);
    q += move;
    const Rates change = rates(of_coefficients_, move);
    left.gap += change.gap;
    left.slip += change.slip;
    impulses.gap -= stiffness_ * left.gap;
    impulses.slip -= stiffness_ * left.slip;
    const double moved = move.norm();
    if (moved <= small_motion * q.norm() || moved > last / 2) break;
    last = moved;
  }
  return q;
}

VectorXd Hold::jump(const VectorXd& v) const {
  Rates left = rates(contacts_, v), impulses;
  VectorXd q = take_out(left, {}, impulses);

  // What it takes from the kinetic energy and from what moves the supports is linear - quadratic in q.
  double taken = -q.dot(motions_.coefficients(v));
  VectorXd of_supports = VectorXd::Zero(v.size());
  for (const HeldUnknown& held : blocks_.held_unknowns()) of_supports[held.unknown] = v[held.unknown];
  if (!of_supports.isZero(0)) {
    const Rates by_supports = rates(contacts_, of_supports);
    Rates like = rates(of_coefficients_, -q);
    take_out(like, {}, impulses);
    taken -= impulses.gap.dot(by_supports.gap) + impulses.slip.dot(by_supports.slip);
  }
  const double most = q.squaredNorm() / 2;
  if (taken < most) q *= std::max(0.0, taken / most);
  VectorXd jump = VectorXd::Zero(v.size());
  motions_.add_motion(q, jump);
  return jump;
}

HeldJump Hold::with_friction(const VectorXd& jump, const std::vector<HeldFriction>& friction) const {
  Rates left = rates(contacts_, -jump), impulses;
  const VectorXd q = take_out(left, friction, impulses);
  HeldJump result{VectorXd::Zero(jump.size()), impulses.gap, impulses.slip};
  for (std::size_t c = 0; c < friction.size(); ++c)
    result.shear[static_cast<Index>(c)] +=
        friction[c].rate * impulses.gap[static_cast<Index>(c)] + friction[c].given;
  motions_.add_motion(q, result.velocity);
  return result;
}

}  // namespace ddacontact
