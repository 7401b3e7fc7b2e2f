#include <ddacontact/solver/tangent_sweeps.hpp>

#include <ddacontact/solver/small_inverse.hpp>
#include <polyfem/core/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>

namespace ddacontact {

namespace {

constexpr int largest = BlockGroups::largest_block;

}  // namespace

bool TangentSweeps::set(FrictionProblem& problem, const BlockGroups& groups,
                        const std::vector<ContactTerm>& contacts, const std::vector<unsigned char>& active,
                        const std::vector<Coupling>& couplings) {
  groups_ = &groups;
  laws_.resize(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    laws_[c] = {active[c] & 1 ? static_cast<float>(contacts[c].normal_stiffness) : 0,
                active[c] & 2 ? static_cast<float>(contacts[c].tangential_stiffness) : 0, 0};
  for (const Coupling& coupling : couplings)
    laws_[coupling.contact].mixed += static_cast<float>(coupling.rate);
  forces_.resize(static_cast<std::size_t>(groups.n_neighbours()));

  blocks_.resize(static_cast<std::size_t>(groups.n_blocks()));
  int n_sides = 0, n_entries = 0;
  std::size_t n_values = 0;
  for (int b = 0; b < groups.n_blocks(); ++b) {
    Block& block = blocks_[static_cast<std::size_t>(b)];
    block.earlier = {n_sides, 0, n_entries};
    block.inverse = n_values;
    const auto n = static_cast<std::size_t>(groups.unknowns(b).count);
    n_values += n * n;
    n_sides += static_cast<int>(groups.neighbours(b).size());
    for (const BlockGroups::Neighbour& neighbour : groups.neighbours(b)) n_entries += neighbour.n_entries;
  }
  sides_.resize(static_cast<std::size_t>(n_sides));
  entries_.resize(static_cast<std::size_t>(n_entries));
  inverses_.resize(n_values);
  std::atomic<bool> finite = true;
  polyfem::for_ranges(groups.n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) {
      const Range group = groups.group(static_cast<int>(g));
      for (int b = group.first; b < group.end(); ++b)
        if (!set_block(problem, contacts, b)) finite = false;
    }
  });
  return finite;
}

bool TangentSweeps::set_block(FrictionProblem& problem, const std::vector<ContactTerm>& contacts, int b) {
  Block& block = blocks_[static_cast<std::size_t>(b)];
  const Range unknowns = groups_->unknowns(b);
  const auto n = static_cast<Index>(unknowns.count);
  std::array<double, largest * largest> values;
  Eigen::Map<MatrixXd> D(values.data(), n, n);
  std::array<SideEntry, largest / 2> of_side;
  groups_->copy_matrix(problem, b, D);
  int side = block.earlier.first, entry = block.earlier.first_entry;
  const auto add_sides = [&](Sides& sides, const auto& is_of_kind) {
    sides = {side, 0, entry};
    int slot = groups_->first_neighbour(b) - 1;
    for (const auto& [contact, other, back, unused] : groups_->neighbours(b)) {
      ++slot;
      const Law& law = laws_[static_cast<std::size_t>(contact)];
      if (!is_of_kind(other) || (law.normal == 0 && law.shear == 0 && law.mixed == 0)) continue;
      const ContactTerm& term = contacts[static_cast<std::size_t>(contact)];
      const int count = find_entries(term, *groups_, unknowns, of_side.data());
      for (int i = 0; i < count; ++i) {
        const SideEntry& column = of_side[i];
        const double with_gap = law.normal, with_slip = law.shear, mixed = law.mixed;
        const Vec2 normal = with_gap * column.gap, shear = with_slip * column.slip + mixed * column.gap;
        for (int k = 0; k < count; ++k)
          D.block<2, 2>(of_side[k].place, column.place) +=
              of_side[k].gap * normal.transpose() + of_side[k].slip * shear.transpose();
      }
      if (other < 0) continue;
      sides_[static_cast<std::size_t>(side++)] = {slot, back, count, law};
      ++sides.count;
      for (const SideEntry* of = of_side.data(); of < of_side.data() + count; ++of) {
        Entry& to = entries_[static_cast<std::size_t>(entry++)];
        to.coefficients << of->gap.cast<float>(), of->slip.cast<float>();
        to.place = of->place;
      }
    }
  };
  const auto in_group = [&](int other) {
    return other >= 0 && BlockGroups::group_of(other) == BlockGroups::group_of(b);
  };
  add_sides(block.earlier, [&](int other) { return in_group(other) && other < b; });
  add_sides(block.later, [&](int other) { return in_group(other) && other > b; });
  add_sides(block.apart, [&](int other) { return !in_group(other); });
  if (!invert(D.data(), unknowns.count)) return false;
  Eigen::Map<Eigen::MatrixXf>(inverses_.data() + block.inverse, n, n) = D.cast<float>();
  return true;
}

void TangentSweeps::apply(const Vector& b, Vector& x, Vector& y) {
  x.resize(b.size());
  y.resize(b.size());
  polyfem::for_ranges(groups_->n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) sweep(static_cast<int>(g), b, x, y);
  });
  polyfem::for_ranges(groups_->n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) add_apart(static_cast<int>(g), y);
  });
}

void TangentSweeps::leave_forces(const Sides& sides, const float* x) {
  const Entry* entry = entries_.data() + sides.first_entry;
  for (int k = sides.first; k < sides.first + sides.count; ++k) {
    const Side& side = sides_[static_cast<std::size_t>(k)];
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (const Entry* const end = entry + side.n_entries; entry < end; ++entry) {
      const float a = x[entry->place], b = x[entry->place + 1];
      sum += entry->coefficients * Eigen::Array4f(a, b, a, b);
    }
    forces_[static_cast<std::size_t>(side.slot_of_other)] = side.law({sum[0] + sum[1], sum[2] + sum[3]});
  }
}

void TangentSweeps::add_forces(const Sides& sides, float factor, float* y) const {
  const Entry* entry = entries_.data() + sides.first_entry;
  for (int k = sides.first; k < sides.first + sides.count; ++k) {
    const Side& side = sides_[static_cast<std::size_t>(k)];
    const Forces& left = forces_[static_cast<std::size_t>(side.slot)];
    const float gap = factor * left.gap, slip = factor * left.slip;
    const Eigen::Array4f of_both(gap, gap, slip, slip);
    for (const Entry* const end = entry + side.n_entries; entry < end; ++entry) {
      const Eigen::Array4f added = of_both * entry->coefficients;
      y[entry->place] += added[0] + added[2];
      y[entry->place + 1] += added[1] + added[3];
    }
  }
}

void TangentSweeps::sweep(int g, const Vector& b, Vector& x, Vector& y) {
  const Range group = groups_->group(g);
  float forces[largest], change[largest];
  // (D + L) z = b, z in x.
  for (int k = group.first; k < group.end(); ++k) {
    const Block& block = blocks_[static_cast<std::size_t>(k)];
    const auto [first, n] = groups_->unknowns(k);
    std::copy_n(b.data() + first, n, forces);
    add_forces(block.earlier, -1, forces);
    multiply(inverses_.data() + block.inverse, n, forces, x.data() + first);
    leave_forces(block.later, x.data() + first);
  }
  // (D + U) x = D z; what x differs from z by is left to later blocks.
  for (int k = group.end() - 1; k >= group.first; --k) {
    const Block& block = blocks_[static_cast<std::size_t>(k)];
    const auto [first, n] = groups_->unknowns(k);
    if (block.later.count > 0) {
      std::fill_n(forces, n, 0.0F);
      add_forces(block.later, -1, forces);
      multiply(inverses_.data() + block.inverse, n, forces, change);
      for (int i = 0; i < n; ++i) x[first + i] += change[i];
      leave_forces(block.later, change);
    }
    leave_forces(block.earlier, x.data() + first);
    leave_forces(block.apart, x.data() + first);
  }
  // K x = b + L (x - z) + what couples the groups.
  for (int k = group.first; k < group.end(); ++k) {
    const auto [first, n] = groups_->unknowns(k);
    std::copy_n(b.data() + first, n, y.data() + first);
    add_forces(blocks_[static_cast<std::size_t>(k)].earlier, 1, y.data() + first);
  }
}

void TangentSweeps::add_apart(int g, Vector& y) const {
  const Range group = groups_->group(g);
  for (int k = group.first; k < group.end(); ++k)
    add_forces(blocks_[static_cast<std::size_t>(k)].apart, 1, y.data() + groups_->unknowns(k).first);
}

}  // namespace ddacontact
