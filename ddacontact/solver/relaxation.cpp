#include <ddacontact/solver/relaxation.hpp>

#include <ddacontact/solver/small_inverse.hpp>

#include <polyfem/core/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_sweeps = 80;
/// Sweeps in a row in which no more than this part of the contacts changes its state.
constexpr int quiet_sweeps = 3;
constexpr double still_changing = 1e-3;
/// Blocks on which a force changes by no more than this part of it are still at rest for other contacts.
constexpr double negligible_change = 1e-5;

/// Which of the law's cases a force is.
int piece(const ContactForce& force, double bound) {
  return force.normal == 0 && bound == 0 ? 0 : force.shear >= bound ? 1 : force.shear <= -bound ? 2 : 3;
}

}  // namespace

/// The force that the law demands while those of the other contacts stay.
/// \param[in] own  gap and slip without the contact's own forces
ContactForce ContactRelaxation::solve(const Local& local, const GapSlip& own, const ContactForce& before) {
  const double an = local.normal_compliance + local.normal, rn = local.reach - own.gap,
               least = local.unilateral ? -local.tension : -infinity;
  const ContactForce pressed{std::max(least, rn / an), 0};
  if (!local.sheared) return pressed;
  const auto bound_under = [&](double normal) {
    return local.slides ? shear_bound(*local.law.joint, normal, local.law.bonded) : infinity;
  };
  const double bound_before = bound_under(before.normal);
  const double multiplier = local.law.sliding && local.slides
                                ? std::copysign(bound_before, local.law.shear)
                                : std::clamp(local.law.shear, -bound_before, bound_before);
  const double at = local.tangential_compliance + local.shear,
               rt = multiplier * local.tangential_compliance - own.slip, mixed = local.mixed;
  const double determinant = an * at - mixed * mixed;
  const ContactForce stuck{(rn * at - rt * mixed) / determinant, (rt * an - rn * mixed) / determinant};
  if (stuck.normal > least && std::abs(stuck.shear) <= bound_under(stuck.normal)) return stuck;
  // Where friction that sticks would pull the contact open it slides under what presses without it; a bond
  // that is pulled open bears shear.
  const double near = stuck.normal > least ? stuck.normal : pressed.normal;
  if (near <= least || !local.slides) {
    const double bound = bound_under(least);
    return {least, std::clamp((rt - mixed * least) / at, -bound, bound)};
  }
  // N with T = +- bound(N), the bound linear from there.
  const double sense = stuck.shear > 0 ? 1 : -1, bound = bound_under(near),
               rate = sense * friction_rate(*local.law.joint, near, local.law.bonded);
  const double normal = std::max(least, (rn - mixed * (sense * bound - rate * near)) / (an + rate * mixed));
  return {normal, sense * bound_under(normal)};
}

int ContactRelaxation::relax(FrictionProblem& problem, const BlockGroups& groups,
                             const std::vector<ContactTerm>& terms, const std::vector<RelaxedLaw>& laws,
                             const VectorXd& residual, VectorXd& d, std::vector<ContactForce>& forces) {
  // Contacts by their later block; the other one is earlier, held, or none.
  locals_.clear();
  locals_.reserve(terms.size());
  first_of_group_.assign(1, 0);
  local_of_.assign(terms.size(), -1);
  int n_entries = 0;
  std::size_t n_answers = 0;
  const auto append = [&](int block, const BlockGroups::Neighbour& neighbour) {
    const int contact = neighbour.contact, other = neighbour.block;
    if (terms[static_cast<std::size_t>(contact)].normal == ContactTerm::Normal::absent) return;
    local_of_[static_cast<std::size_t>(contact)] = static_cast<int>(locals_.size());
    Local& local = locals_.emplace_back();
    local.contact = contact;
    for (int side : {0, 1}) {
      const int b = side == 0 ? block : other;
      if (b < 0) continue;
      const Range unknowns = groups.unknowns(b);
      local.sides[static_cast<std::size_t>(side)] = {b, unknowns.first, unknowns.count, n_entries,
                                                     0, n_answers};
      n_entries += side == 0 ? neighbour.n_entries : groups.neighbour(neighbour.back).n_entries;
      n_answers += 2 * static_cast<std::size_t>(unknowns.count);
    }
  };
  const auto is_within = [](int block, int other) {
    return other < 0 || BlockGroups::group_of(block) == BlockGroups::group_of(other);
  };
  for (int g = 0; g < groups.n_groups(); ++g) {
    const Range group = groups.group(g);
    for (int b = group.first; b < group.end(); ++b)
      for (const BlockGroups::Neighbour& neighbour : groups.neighbours(b))
        if (neighbour.block < b && is_within(b, neighbour.block)) append(b, neighbour);
    first_of_group_.push_back(static_cast<int>(locals_.size()));
  }
  for (int b = 0; b < groups.n_blocks(); ++b)
    for (const BlockGroups::Neighbour& neighbour : groups.neighbours(b))
      if (neighbour.block < b && !is_within(b, neighbour.block)) append(b, neighbour);

  entries_.resize(static_cast<std::size_t>(n_entries));
  answers_.resize(n_answers);
  moves_.assign(static_cast<std::size_t>(groups.n_blocks()), 0);
  groups.pack(residual, change_);
  std::atomic<bool> finite = true;
  polyfem::for_ranges(groups.n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) {
      const Range group = groups.group(static_cast<int>(g));
      for (int b = group.first; b < group.end(); ++b)
        if (!set_block(problem, groups, terms, b)) finite = false;
    }
  });
  if (!finite) return -1;
  polyfem::for_ranges(static_cast<Index>(locals_.size()), 256, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      Local& local = locals_[static_cast<std::size_t>(k)];
      const ContactTerm& term = terms[static_cast<std::size_t>(local.contact)];
      local.law = laws[static_cast<std::size_t>(local.contact)];
      local.unilateral = term.normal == ContactTerm::Normal::unilateral;
      local.slides = !std::isinf(term.bound);
      local.tension = term.tension;
      local.sheared = term.sheared && (term.bound > 0 || local.law.joint->has_friction());
      local.normal_compliance = 1 / term.normal_stiffness;
      local.tangential_compliance = 1 / term.tangential_stiffness;
      local.reach = term.normal_multiplier * local.normal_compliance;
      local.start = {term.gap(d), term.sheared ? term.slip(d) : 0};
      local.normal = local.mixed = local.shear = 0;
      for (const Side& side : local.sides) {
        if (side.block < 0) continue;
        const SideEntry* const entries = entries_.data() + side.first_entry;
        const double* const answer = answers_.data() + side.first_answer;
        const GapSlip of_normal = change_of(entries, side.n_entries, answer),
                      of_shear = change_of(entries, side.n_entries, answer + side.n);
        local.normal += of_normal.gap;
        local.mixed += of_shear.gap;
        local.shear += of_shear.slip;
      }
    }
  });

  const auto look_at_all = [&](int first, int end, bool forth) {
    int n_changed = 0;
    for (int k = 0; k < end - first; ++k) {
      Local& local = locals_[static_cast<std::size_t>(forth ? first + k : end - 1 - k)];
      const auto c = static_cast<std::size_t>(local.contact);
      if (look_at(local, forces[c])) ++n_changed;
    }
    return n_changed;
  };
  int quiet = 0, sweep = 0;
  std::vector<int> n_changed(static_cast<std::size_t>(groups.n_groups()));
  for (; sweep < most_sweeps && quiet < quiet_sweeps; ++sweep) {
    const bool forth = sweep % 2 == 0;
    polyfem::for_ranges(groups.n_groups(), 1, [&](Index begin, Index end) {
      for (Index g = begin; g < end; ++g) {
        const auto group = static_cast<std::size_t>(g);
        n_changed[group] = look_at_all(first_of_group_[group], first_of_group_[group + 1], forth);
      }
    });
    int all = look_at_all(first_of_group_.back(), static_cast<int>(locals_.size()), forth);
    for (int of_group : n_changed) all += of_group;
    quiet = all <= still_changing * static_cast<double>(terms.size()) ? quiet + 1 : 0;
  }
  VectorXd moved;
  groups.unpack(change_, moved);
  d += moved;
  return sweep;
}

bool ContactRelaxation::set_block(FrictionProblem& problem, const BlockGroups& groups,
                                  const std::vector<ContactTerm>& terms, int b) {
  const Range unknowns = groups.unknowns(b);
  const Index n = unknowns.count;
  std::array<double, BlockGroups::largest_block * BlockGroups::largest_block> values;
  Eigen::Map<MatrixXd> inverse(values.data(), n, n);
  groups.copy_matrix(problem, b, inverse);
  if (!invert(values.data(), unknowns.count)) return false;
  auto own = change_.segment(unknowns.first, n);
  own = (-inverse * own).eval();
  for (const auto& [contact, other, back, n_entries] : groups.neighbours(b)) {
    const int k = local_of_[static_cast<std::size_t>(contact)];
    if (k < 0) continue;
    Side& side = locals_[static_cast<std::size_t>(k)].sides[other < b ? 0 : 1];
    SideEntry* const entries = entries_.data() + side.first_entry;
    const ContactTerm& term = terms[static_cast<std::size_t>(contact)];
    side.n_entries = find_entries(term, groups, unknowns, entries);
    Eigen::Map<VectorXd> of_normal(answers_.data() + side.first_answer, n),
        of_shear(answers_.data() + side.first_answer + n, n);
    of_normal.setZero();
    of_shear.setZero();
    for (const SideEntry* entry = entries; entry < entries + side.n_entries; ++entry)
      for (Index axis = 0; axis < 2; ++axis) {
        of_normal += entry->gap[axis] * inverse.col(entry->place + axis);
        of_shear += entry->slip[axis] * inverse.col(entry->place + axis);
      }
  }
  return true;
}

bool ContactRelaxation::look_at(Local& local, ContactForce& force) {
  bool rests = true;
  for (const Side& side : local.sides)
    rests = rests && (side.block < 0 || moves_[static_cast<std::size_t>(side.block)] == side.seen);
  if (rests) return false;
  GapSlip now = local.start;
  for (const Side& side : local.sides) {
    if (side.block < 0) continue;
    const GapSlip change =
        change_of(entries_.data() + side.first_entry, side.n_entries, change_.data() + side.first);
    now.gap += change.gap;
    now.slip += change.slip;
  }
  const ContactForce before = force;
  const bool stays_open = local.unilateral && local.slides && !local.law.bonded && before.normal == 0 &&
                          before.shear == 0 && now.gap >= local.reach;
  const GapSlip own{now.gap - local.normal * before.normal - local.mixed * before.shear,
                    now.slip - local.mixed * before.normal - local.shear * before.shear};
  const ContactForce after = stays_open ? before : solve(local, own, before);
  const double normal = after.normal - before.normal, shear = after.shear - before.shear;
  force = after;
  const auto piece_of = [&](const ContactForce& of) {
    return piece(of, local.slides ? shear_bound(*local.law.joint, of.normal, local.law.bonded) : infinity);
  };
  const bool changed = !stays_open && piece_of(before) != piece_of(after);
  const bool moves = changed || std::abs(normal) + std::abs(shear) >
                                    negligible_change * (std::abs(after.normal) + std::abs(after.shear));
  for (Side& side : local.sides) {
    if (side.block < 0) continue;
    int& of_block = moves_[static_cast<std::size_t>(side.block)];
    if (moves) ++of_block;
    side.seen = of_block;
    if (normal == 0 && shear == 0) continue;
    const double* const answer = answers_.data() + side.first_answer;
    double* const x = change_.data() + side.first;
    for (int k = 0; k < side.n; k += 2)
      Eigen::Map<Vec2>(x + k) +=
          Eigen::Map<const Vec2>(answer + k) * normal + Eigen::Map<const Vec2>(answer + side.n + k) * shear;
  }
  return changed;
}

}  // namespace ddacontact
