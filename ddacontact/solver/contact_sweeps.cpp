#include <ddacontact/solver/contact_sweeps.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/solver/small_product.hpp>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

namespace ddacontact {

namespace {

/// The n x n matrix of these values becomes its inverse, by elimination in place without exchanging rows: the
/// matrices are positive definite. False: it has none that is finite.
template <int N>
bool invert(double* values, Index n) {
  Eigen::Map<Eigen::Matrix<double, N, N>> A(values, n, n);
  using Column =
      Eigen::Matrix<double, N, 1, Eigen::ColMajor, N == Eigen::Dynamic ? ContactSweeps::largest_block : N, 1>;
  for (Index p = 0; p < n; ++p) {
    const double inverse = 1 / A(p, p);
    if (!std::isfinite(inverse)) return false;
    Column column = A.col(p);
    column[p] = 0;
    for (Index k = 0; k < n; ++k) {
      if (k == p) continue;
      const double factor = A(p, k) * inverse;
      A.col(k) -= factor * column;
      A(p, k) = factor;
    }
    A.col(p) = -inverse * column;
    A(p, p) = inverse;
  }
  return true;
}

/// Open, at the bound of friction in either sense, or within it.
SpringState state_of(const ContactForce& force, double bound) {
  if (force.normal <= 0 && force.shear == 0) return none_acts;
  return force.shear >= bound ? at_upper : force.shear <= -bound ? at_lower : all_act;
}

}  // namespace

bool ContactSweeps::set(FrictionProblem& problem, const std::vector<ContactTerm>& terms) {
  if (!take_blocks(problem)) return false;
  take_contacts(terms);
  return true;
}

bool ContactSweeps::take_blocks(FrictionProblem& problem) {
  const std::vector<int>& equation = problem.equation();
  const polyfem::Connectivity& unknowns = problem.unknowns();
  slot_.assign(equation.size(), -1);
  unknown_.clear();
  block_of_.clear();
  blocks_.clear();
  std::size_t n_values = 0;
  for (int e = 0; e < unknowns.n_elements(); ++e) {
    const std::span<const int> of_block = unknowns.rows_of(e);
    const auto n = static_cast<int>(of_block.size());
    const auto is_prescribed = [&](int u) { return equation[u] < 0; };
    if (std::ranges::all_of(of_block, is_prescribed)) continue;
    if (n > largest_block || n % 2 != 0) return false;
    for (int u : of_block) {
      if (slot_[u] >= 0) return false;
      if (!is_prescribed(u)) slot_[u] = static_cast<int>(unknown_.size());
      unknown_.push_back(is_prescribed(u) ? -1 : u);
      block_of_.push_back(static_cast<int>(blocks_.size()));
    }
    blocks_.push_back({e, static_cast<int>(unknown_.size()) - n, n, n_values});
    n_values += static_cast<std::size_t>(n * n);
  }
  inverses_.resize(n_values);
  std::atomic<bool> finite = true;
  for_all(blocks_.size(), [&](Index b) {
    const auto [matrix, first, n, inverse] = blocks_[b];
    double* const values = inverses_.data() + inverse;
    Eigen::Map<MatrixXd> A(values, n, n);
    A = problem.elements()[matrix];
    for (int k = 0; k < n; ++k) {
      if (unknown_[first + k] >= 0) continue;
      A.row(k).setZero();
      A.col(k).setZero();
      A(k, k) = 1;
    }
    if (!(n == quadrilateral ? invert<quadrilateral>(values, n) : invert<Eigen::Dynamic>(values, n)))
      finite = false;
  });
  return finite;
}

void ContactSweeps::take_contacts(const std::vector<ContactTerm>& terms) {
  rows_.clear();
  rows_.reserve(terms.size());
  int n_entries = 0;
  std::size_t n_columns = 0;
  for (std::size_t c = 0; c < terms.size(); ++c) {
    Row row;
    row.contact = static_cast<int>(c);
    row.first_entry = n_entries;
    std::array<int, AffineForm::capacity> seen;
    auto& [one, other] = row.sides;
    for (int u : terms[c].gap.unknowns()) {
      const int slot = slot_[u];
      if (slot < 0) continue;
      const int first = slot & ~1, block = block_of_[slot];
      const auto end = seen.begin() + row.n_entries;
      if (std::find(seen.begin(), end, first) != end) continue;
      seen[row.n_entries++] = first;
      if (block != one.block) (one.block < 0 ? one : other).block = block;
    }
    n_entries += row.n_entries;
    if (other.block >= 0 && other.block < one.block) std::swap(one, other);
    for (Side& side : row.sides) {
      if (side.block < 0) continue;
      const Block& block = blocks_[side.block];
      side = {side.block, block.first, block.n, n_columns};
      n_columns += static_cast<std::size_t>(2 * block.n);
    }
    rows_.push_back(row);
  }
  order_rows();
  entries_.resize(n_entries);
  columns_.resize(n_columns);
  for_all(rows_.size(), [&](Index r) {
    Row& row = rows_[r];
    set_entries(terms[row.contact], row);
  });
}

/// Groups are as many blocks as follow one another when the contacts are walked along from a first one.
void ContactSweeps::order_rows() {
  const std::size_t n_blocks = blocks_.size();
  if (n_blocks <= group_size) {
    const auto end = static_cast<int>(rows_.size());
    first_of_group_ = {0, end, end};
    return;
  }
  std::vector<std::vector<int>> neighbours(n_blocks);
  for (const Row& row : rows_) {
    const int a = row.sides[0].block, b = row.sides[1].block;
    if (b < 0) continue;  // beside a block that does not move, or between two
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  std::vector<int> group(n_blocks, -1), walk;
  walk.reserve(n_blocks);
  const auto meet = [&](int block) {
    int& of_block = group[block];
    if (of_block >= 0) return;
    of_block = static_cast<int>(walk.size()) / group_size;
    walk.push_back(block);
  };
  std::size_t next = 0;
  for (std::size_t start = 0; start < n_blocks; ++start) {
    meet(static_cast<int>(start));
    for (; next < walk.size(); ++next)
      for (int other : neighbours[walk[next]]) meet(other);
  }
  const int n_groups = group[walk.back()] + 1;
  std::vector<std::array<int, 2>> keys(rows_.size());
  first_of_group_.assign(n_groups + 2, 0);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const int a = rows_[r].sides[0].block, b = rows_[r].sides[1].block;
    const int of_a = a < 0 ? 0 : group[a];
    const bool within = b < 0 || group[b] == of_a;
    keys[r] = {within ? of_a : n_groups, static_cast<int>(r)};
    ++first_of_group_[keys[r][0] + 1];
  }
  std::partial_sum(first_of_group_.begin(), first_of_group_.end(), first_of_group_.begin());
  std::ranges::sort(keys);
  std::vector<Row> ordered;
  ordered.reserve(rows_.size());
  for (const auto& [of_group, r] : keys) ordered.push_back(rows_[r]);
  rows_ = std::move(ordered);
}

void ContactSweeps::set_entries(const ContactTerm& term, Row& row) {
  const std::span<const int> u = term.gap.unknowns();
  const bool sheared = term.slip.unknowns().size() == u.size();
  Entry* const entries = entries_.data() + row.first_entry;
  int n = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const int slot = slot_[u[k]];
    if (slot < 0) continue;
    const int first = slot & ~1;
    Entry* entry = std::find_if(entries, entries + n, [&](const Entry& e) { return e.slot == first; });
    if (entry == entries + n) {
      *entry = {first, Vec2::Zero(), Vec2::Zero()};
      ++n;
    }
    entry->gap[slot & 1] = term.gap.coefficients()[k];
    if (sheared) entry->slip[slot & 1] = term.slip.coefficients()[k];
  }
  row.normal = row.mixed = row.shear = 0;
  for (const Side& side : row.sides) {
    if (side.block < 0) continue;
    const double* const inverse = inverses_.data() + blocks_[side.block].inverse;
    double *const normal = columns_.data() + side.columns, *const shear = normal + side.n;
    std::fill(normal, shear + side.n, 0);
    const auto for_own_entries = [&](const auto& work) {
      for (const Entry* entry = entries; entry < entries + n; ++entry)
        if (const int at = entry->slot - side.first; at >= 0 && at < side.n) work(*entry, at);
    };
    for_own_entries([&](const Entry& entry, int at) {
      const double *const by_first = inverse + at * side.n, *const by_second = by_first + side.n;
      for (int k = 0; k < side.n; ++k) {
        normal[k] += entry.gap[0] * by_first[k] + entry.gap[1] * by_second[k];
        shear[k] += entry.slip[0] * by_first[k] + entry.slip[1] * by_second[k];
      }
    });
    for_own_entries([&](const Entry& entry, int at) {
      row.normal += entry.gap[0] * normal[at] + entry.gap[1] * normal[at + 1];
      row.mixed += entry.gap[0] * shear[at] + entry.gap[1] * shear[at + 1];
      row.shear += entry.slip[0] * shear[at] + entry.slip[1] * shear[at + 1];
    });
  }
}

/// What a contact's forces change of a block's displacements.
void ContactSweeps::move(const Side& side, double normal, double shear) {
  const double* const columns = columns_.data() + side.columns;
  double* const x = change_.data() + side.first;
  const auto add = [&]<int N>(std::integral_constant<int, N>) {
    using Column = Eigen::Matrix<double, N, 1>;
    Eigen::Map<Column>(x, side.n) += normal * Eigen::Map<const Column>(columns, side.n) +
                                     shear * Eigen::Map<const Column>(columns + side.n, side.n);
  };
  if (side.n == quadrilateral)
    add(std::integral_constant<int, quadrilateral>{});
  else
    add(std::integral_constant<int, Eigen::Dynamic>{});
}

/// Gives a contact the force that its law demands. Returns how much that changed over the tolerance.
double ContactSweeps::visit(Row& row, const Tolerance& tolerance) {
  if (!row.acts) return 0;
  const Entry *const first = entries_.data() + row.first_entry, *const end = first + row.n_entries;
  double gap = row.gap, slip = row.slip;
  for (const Entry* entry = first; entry < end; ++entry) {
    const Eigen::Map<const Vec2> x(change_.data() + entry->slot);
    gap += entry->gap.dot(x);
    slip += entry->slip.dot(x);
  }
  const ContactForce before = row.force;
  if (row.unilateral && row.slides && !row.law.bonded && before.normal == 0 && before.shear == 0 && gap >= 0)
    return 0;
  row.force = row.solve(gap - row.normal * before.normal - row.mixed * before.shear,
                        slip - row.mixed * before.normal - row.shear * before.shear);
  const double normal = row.force.normal - before.normal, shear = row.force.shear - before.shear;
  if (normal == 0 && shear == 0) return 0;
  for (const Side& side : row.sides)
    if (side.block >= 0) move(side, normal, shear);
  const double change = std::abs(normal) + std::abs(shear),
               of_gap =
                   row.law.gap > 0 ? (row.normal + row.normal_compliance) / (tolerance.gap * row.law.gap) : 0;
  return change * std::max(1 / (tolerance.force * row.law.scale), of_gap);
}

/// Returns the largest change.
double ContactSweeps::visit_all(bool forth, const Tolerance& tolerance) {
  const auto visit_group = [&](Index group) {
    const auto g = static_cast<std::size_t>(group);
    double largest = 0;
    const int first = first_of_group_[g], end = first_of_group_[g + 1];
    for (int k = 0; k < end - first; ++k)
      largest = std::max(largest, visit(rows_[forth ? first + k : end - 1 - k], tolerance));
    return largest;
  };
  VectorXd largest(n_groups() + 1);
  polyfem::for_ranges(n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) largest[g] = visit_group(g);
  });
  largest[n_groups()] = visit_group(n_groups());
  return largest.maxCoeff();
}

/// Whether many of the contacts that are or were closed have changed their states.
bool ContactSweeps::has_many_changes(const Stop& stop) const {
  int n_closed = 0, n_changed = 0;
  for (const Row& row : rows_) {
    const SpringState now = state_of(row.force, row.bound_under(row.force.normal));
    if (now == none_acts && row.state_before == none_acts) continue;
    ++n_closed;
    if (now != row.state_before) ++n_changed;
  }
  return n_changed > stop.few && n_changed > stop.many * n_closed;
}

VectorXd ContactSweeps::forces() const {
  VectorXd all(2 * static_cast<Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r)
    all.segment<2>(2 * static_cast<Index>(r)) << rows_[r].force.normal, rows_[r].force.shear;
  return all;
}

void ContactSweeps::begin(const std::vector<ContactTerm>& terms, const std::vector<SweptLaw>& laws,
                          const VectorXd& residual, const VectorXd& d,
                          const std::vector<ContactForce>& forces_of_all) {
  change_.resize(unknown_.size());
  for_all(blocks_.size(), [&](Index b) {
    const auto [matrix, first, n, inverse] = blocks_[b];
    auto change = change_.segment(first, n);
    for (int k = 0; k < n; ++k) {
      const int u = unknown_[first + k];
      change[k] = u < 0 ? 0 : -residual[u];
    }
    change = (Eigen::Map<const MatrixXd>(inverses_.data() + inverse, n, n) * change).eval();
  });
  for_all(rows_.size(), [&](Index r) {
    Row& row = rows_[r];
    const auto c = static_cast<std::size_t>(row.contact);
    row.set_law(terms[c], laws[c], d);
    row.force = forces_of_all[c];
    row.state_before = state_of(row.force, row.bound_under(row.force.normal));
  });
}

ContactSweeps::Report ContactSweeps::sweep(const std::vector<ContactTerm>& terms,
                                           const std::vector<SweptLaw>& laws, const VectorXd& residual,
                                           const Stop& stop, VectorXd& d,
                                           std::vector<ContactForce>& forces_of_all) {
  begin(terms, laws, residual, d, forces_of_all);
  Report report;
  VectorXd along_force, along;  // the direction of conjugate gradients
  for (double before = 0; report.sweeps < stop.most_sweeps;) {
    const VectorXd force = forces(), change = change_;
    const Tolerance& tolerance = report.many_changes ? stop.many_changes : stop.quiet;
    for (bool forth : {true, false}) {
      ++report.sweeps;
      report.settled = visit_all(forth, tolerance) <= 1;
      if (report.settled) break;
    }
    if (before == 0 && has_many_changes(stop)) {
      report.many_changes = true;
      report.settled = report.settled && stop.quiet.force <= stop.many_changes.force;
    }
    if (report.settled) break;
    const VectorXd by_force = forces() - force, by = change_ - change;
    const double now = by_force.squaredNorm(), further = now / before;
    if (!std::isfinite(now)) break;
    before = now;
    if (!(further <= 1)) {
      along_force = by_force;
      along = by;
      continue;
    }
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      rows_[r].force.normal += further * along_force[2 * static_cast<Index>(r)];
      rows_[r].force.shear += further * along_force[2 * static_cast<Index>(r) + 1];
    }
    change_ += further * along;
    along_force = further * along_force + by_force;
    along = further * along + by;
  }
  report.settled = report.settled && change_.allFinite();
  for (const Row& row : rows_) forces_of_all[row.contact] = row.force;
  for (std::size_t k = 0; k < unknown_.size(); ++k)
    if (unknown_[k] >= 0) d[unknown_[k]] += change_[k];
  return report;
}

}  // namespace ddacontact
