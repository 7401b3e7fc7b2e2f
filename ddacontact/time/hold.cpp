#include <ddacontact/time/hold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ddacontact {

namespace {

/// Springs against rates times what a unit of impulse changes them: the inverse of this is left of a rate in
/// a round, and more of rates that hardly any motion of the blocks as wholes changes. Those are let be: what
/// blocks do that slide along each other while they deform is such a motion.
constexpr double stiffness_factor = 1e4;
constexpr int most_rounds = 10;
/// A round that moves less than this part of all, or what is negligible, is the last one, and so is one that
/// gains less than half.
constexpr double small_motion = 1e-7;
/// Of the rates that normal impulses answer: of all, and in a round that others follow.
constexpr double friction_tolerance = 1e-6, friction_tolerance_of_round = 1e-3;
constexpr double rough_friction_tolerance = 1e-4;

/// That takes out a rate by all but 1 / stiffness_factor when its contact is the only one.
double stiffness_against(const AffineForm& rate) {
  double answer = 0;
  for (double c : rate.coefficients()) answer += c * c;
  return answer > 0 ? stiffness_factor / answer : 0;
}

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

Hold::Hold(const BlockSystem& blocks, const std::vector<HeldContact>& contacts, double negligible,
           HoldFactor& factor)
    : blocks_(blocks),
      contacts_(contacts),
      motions_(blocks, blocks_of(blocks, contacts)),
      negligible_(negligible * std::sqrt(motions_.smallest_mass())),
      stiffness_(zeros(contacts.size())),
      factor_(factor) {
  of_coefficients_.reserve(contacts.size());
  for (const HeldContact& contact : contacts) {
    const auto c = static_cast<Index>(of_coefficients_.size());
    of_coefficients_.push_back(
        {motions_.rate_form(contact.gap), motions_.rate_form(contact.slip), contact.tangential});
    stiffness_.gap[c] = stiffness_against(of_coefficients_.back().gap);
    if (contact.tangential) stiffness_.slip[c] = stiffness_against(of_coefficients_.back().slip);
  }
  factorize();
}

Hold::Rates Hold::zeros(std::size_t n) {
  return {VectorXd::Zero(static_cast<Index>(n)), VectorXd::Zero(static_cast<Index>(n))};
}

void Hold::factorize() {
  polyfem::Connectivity elements;
  for (const HeldContact& contact : of_coefficients_) elements.append(contact.gap.unknowns());
  const int n = motions_.n_coefficients();
  auto& [matrix, cholesky] = factor_;
  const bool changed = matrix.set_connectivity(n, elements);
  matrix.set_identity();
  for (std::size_t c = 0; c < of_coefficients_.size(); ++c) {
    const HeldContact& contact = of_coefficients_[c];
    const int element = static_cast<int>(c);
    const auto k = static_cast<Index>(c);
    matrix.add_outer(element, stiffness_.gap[k], contact.gap.coefficients());
    if (contact.tangential) matrix.add_outer(element, stiffness_.slip[k], contact.slip.coefficients());
  }
  if (changed) cholesky.analyze(matrix.lower());
  if (!cholesky.factorize(matrix.lower())) throw std::logic_error("a sum of squares is not positive");
}

Hold::Rates Hold::rates(const std::vector<HeldContact>& forms, const VectorXd& v) {
  const auto n = static_cast<Index>(forms.size());
  Rates rates = zeros(forms.size());
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
bool Hold::take_out(Rates& left, const std::vector<HeldFriction>& friction, bool rough, VectorXd& q,
                    Rates& impulses) const {
  const auto n = static_cast<Index>(of_coefficients_.size());
  std::vector<Coupling> couplings;
  for (std::size_t c = 0; c < friction.size(); ++c)
    if (friction[c].rate != 0)
      couplings.push_back({&of_coefficients_[c].slip, &of_coefficients_[c].gap,
                           friction[c].rate * stiffness_.gap[static_cast<Index>(c)]});
  impulses = zeros(of_coefficients_.size());
  q.setZero(motions_.n_coefficients());
  VectorXd lacking, move;
  bool settled = true;
  const auto solve = [&](const VectorXd& b, VectorXd& x) { factor_.cholesky.solve(b, x); };
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_rounds; ++round) {
    lacking = -q;
    for (Index c = 0; c < n; ++c) {
      const std::size_t k = static_cast<std::size_t>(c);
      const HeldContact& form = of_coefficients_[k];
      const double normal = impulses.gap[c] - stiffness_.gap[c] * left.gap[c];
      double shear = impulses.slip[c] - stiffness_.slip[c] * left.slip[c];
      if (!friction.empty()) shear += friction[k].rate * normal + friction[k].given;
      form.gap.add_gradient(normal, lacking);
      form.slip.add_gradient(shear, lacking);
    }
    const double of_all = round == 0 ? 1 : friction_tolerance * q.norm() / last,
                 tolerance = rough ? rough_friction_tolerance
                                   : std::clamp(of_all, friction_tolerance, friction_tolerance_of_round);
    settled = solve_coupled(solve, solve, couplings, lacking, tolerance, move) && settled;
    q += move;
    const Rates change = rates(of_coefficients_, move);
    left.gap += change.gap;
    left.slip += change.slip;
    impulses.gap -= stiffness_.gap.cwiseProduct(left.gap);
    impulses.slip -= stiffness_.slip.cwiseProduct(left.slip);
    const double moved = move.norm();
    if (rough || moved <= std::max(small_motion * q.norm(), negligible_) || moved > last / 2) break;
    last = moved;
  }
  return settled;
}

VectorXd Hold::jump(const VectorXd& v) const {
  Rates left = rates(contacts_, v), impulses;
  VectorXd q;
  take_out(left, {}, false, q, impulses);

  // What it takes from the kinetic energy and from what moves the supports is linear - quadratic in q.
  double taken = -q.dot(motions_.coefficients(v));
  VectorXd of_supports = VectorXd::Zero(v.size());
  for (const HeldUnknown& held : blocks_.held_unknowns()) of_supports[held.unknown] = v[held.unknown];
  if (!of_supports.isZero(0)) {
    const Rates by_supports = rates(contacts_, of_supports);
    Rates like = rates(of_coefficients_, -q);
    VectorXd again;
    take_out(like, {}, false, again, impulses);
    taken -= impulses.gap.dot(by_supports.gap) + impulses.slip.dot(by_supports.slip);
  }
  const double most = q.squaredNorm() / 2;
  if (taken < most) q *= std::max(0.0, taken / most);
  VectorXd jump = VectorXd::Zero(v.size());
  motions_.add_motion(q, jump);
  return jump;
}

HeldJump Hold::with_friction(const VectorXd& jump, const std::vector<HeldFriction>& friction,
                             bool rough) const {
  Rates left = rates(contacts_, -jump), impulses;
  VectorXd q;
  const bool settled = take_out(left, friction, rough, q, impulses);
  HeldJump result{VectorXd::Zero(jump.size()), impulses.gap, impulses.slip, settled};
  for (std::size_t c = 0; c < friction.size(); ++c)
    result.shear[static_cast<Index>(c)] +=
        friction[c].rate * impulses.gap[static_cast<Index>(c)] + friction[c].given;
  motions_.add_motion(q, result.velocity);
  return result;
}

}  // namespace ddacontact
