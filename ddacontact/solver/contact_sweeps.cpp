#include <ddacontact/solver/contact_sweeps.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/solver/anderson.hpp>
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

/// Differences of iterates that the acceleration keeps: more save fewer sweeps than their vectors cost.
constexpr Index anderson_depth = 3;

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
  rows_.assign(terms.size(), {});
  for (std::size_t c = 0; c < terms.size(); ++c) {
    Row& row = rows_[c];
    row.contact = static_cast<int>(c);
    auto& [one, other] = row.sides;
    int last = -1;
    for (int u : terms[c].gap.unknowns()) {
      const int slot = slot_[u];
      if (slot < 0) continue;
      if (const int block = block_of_[slot]; block != one.block) (one.block < 0 ? one : other).block = block;
      if ((slot & ~1) != last) ++row.n_entries;
      last = slot & ~1;
    }
    if (other.block >= 0 && other.block < one.block) std::swap(one, other);
  }
  order_rows();
  int n_entries = 0;
  std::size_t n_columns = 0;
  for (Row& row : rows_) {
    row.first_entry = n_entries;
    n_entries += row.n_entries;
    for (Side& side : row.sides) {
      if (side.block < 0) continue;
      const Block& block = blocks_[side.block];
      side = {side.block, block.first, block.n, n_columns};
      n_columns += static_cast<std::size_t>(2 * block.n);
    }
  }
  entries_.resize(n_entries);
  columns_.resize(n_columns);
  for_all(rows_.size(), [&](Index r) { set_entries(terms[rows_[r].contact], rows_[r]); });
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
  Entry *const begin = entries_.data() + row.first_entry, *end = begin;
  for (const Side& side : row.sides) {
    if (side.block < 0) continue;
    const Entry* const own = end;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const int slot = slot_[u[k]], first = slot & ~1;
      if (slot < side.first || slot >= side.first + side.n) continue;
      if (end == own || end[-1].slot != first) *end++ = {first, {}};
      end[-1].by[slot - first] = {term.gap.coefficients()[k], sheared ? term.slip.coefficients()[k] : 0};
    }
    const double* const inverse = inverses_.data() + blocks_[side.block].inverse;
    double* const columns = columns_.data() + side.columns;
    std::fill(columns, columns + 2 * side.n, 0);
    for (const Entry* entry = own; entry < end; ++entry) {
      const int n = side.n;
      const double* const from = inverse + (entry->slot - side.first) * n;
      const auto [x, y] = entry->by;
      for (int k = 0; k < n; k += 2) {
        const Eigen::Map<const Vec2> by_x(from + k), by_y(from + n + k);
        Eigen::Map<Vec2>(columns + k) += x[0] * by_x + y[0] * by_y;
        Eigen::Map<Vec2>(columns + n + k) += x[1] * by_x + y[1] * by_y;
      }
    }
    for (const Entry* entry = own; entry < end; ++entry) {
      const double *const normal = columns + entry->slot - side.first, *const shear = normal + side.n;
      for (int k : {0, 1}) {
        row.normal += entry->by[k][0] * normal[k];
        row.mixed += entry->by[k][0] * shear[k];
        row.shear += entry->by[k][1] * shear[k];
      }
    }
  }
  row.n_entries = static_cast<int>(end - begin);
}

/// Gives a contact the force that its law demands.
void ContactSweeps::visit(int r, Vec2& largest) {
  const Row& row = rows_[r];
  if (!row.acts) return;
  Vec2 at(row.gap, row.slip);
  for (const Entry *entry = entries_.data() + row.first_entry, *end = entry + row.n_entries; entry < end;
       ++entry)
    for (int k : {0, 1}) at += change()[entry->slot + k] * Eigen::Map<const Vec2>(entry->by[k].data());
  auto force = forces().col(r);
  if (row.lets_go && force[0] == 0 && force[1] == 0 && at[0] >= 0) return;
  const ContactForce now = row.solve(at[0], at[1], {force[0], force[1]});
  const double normal = now.normal - force[0], shear = now.shear - force[1];
  if (normal == 0 && shear == 0) return;
  force << now.normal, now.shear;
  const auto move = [&]<int N>(const Side& side, std::integral_constant<int, N>) {
    const Eigen::Map<const Eigen::Matrix<double, N, 2>> by(columns_.data() + side.columns, side.n, 2);
    Eigen::Map<Eigen::Matrix<double, N, 1>>(change() + side.first, side.n) +=
        normal * by.col(0) + shear * by.col(1);
  };
  for (const Side& side : row.sides)
    if (side.n == quadrilateral)
      move(side, std::integral_constant<int, quadrilateral>{});
    else
      move(side, std::integral_constant<int, Eigen::Dynamic>{});
  largest = largest.cwiseMax((std::abs(normal) + std::abs(shear)) * row.relative_change);
}

/// Returns the largest changes.
Vec2 ContactSweeps::visit_all() {
  Points largest(2, n_groups() + 1);
  const auto visit_group = [&](Index group) {
    const auto g = static_cast<std::size_t>(group);
    Vec2 of_group = Vec2::Zero();
    for (int r = first_of_group_[g]; r < first_of_group_[g + 1]; ++r) visit(r, of_group);
    largest.col(group) = of_group;
  };
  polyfem::for_ranges(n_groups(), 1, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) visit_group(g);
  });
  visit_group(n_groups());
  return largest.rowwise().maxCoeff();
}

/// Whether many of the contacts that are or were closed have changed their states.
bool ContactSweeps::has_many_changes(const Stop& stop, const Points& before) {
  int n_closed = 0, n_changed = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto state = [&](const auto& of) {
      const auto force = of.col(static_cast<Index>(r));
      return state_of({force[0], force[1]}, rows_[r].bound_under(force[0]));
    };
    const SpringState now = state(forces()), then = state(before);
    if (now == none_acts && then == none_acts) continue;
    ++n_closed;
    if (now != then) ++n_changed;
  }
  return n_changed > stop.few && n_changed > stop.many * n_closed;
}

/// False: a contact is not positive definite.
bool ContactSweeps::begin(const std::vector<ContactTerm>& terms, const std::vector<SweptLaw>& laws,
                          const VectorXd& residual, const VectorXd& d,
                          const std::vector<ContactForce>& forces_of_all) {
  iterate_.resize(static_cast<Index>(2 * rows_.size() + unknown_.size()));
  for_all(blocks_.size(), [&](Index b) {
    const auto [matrix, first, n, inverse] = blocks_[b];
    Eigen::Map<VectorXd> change(this->change() + first, n);
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
    row.relative_change = {1 / laws[c].scale,
                           laws[c].gap > 0 ? (row.normal + row.normal_compliance) / laws[c].gap : 0};
    forces().col(r) << forces_of_all[c].normal, forces_of_all[c].shear;
  });
  return std::ranges::all_of(rows_, [](const Row& row) { return !row.acts || row.is_positive_definite(); });
}

ContactSweeps::Report ContactSweeps::sweep(const std::vector<ContactTerm>& terms,
                                           const std::vector<SweptLaw>& laws, const VectorXd& residual,
                                           const Stop& stop, VectorXd& d,
                                           std::vector<ContactForce>& forces_of_all) {
  assert(terms.size() == rows_.size() && laws.size() == rows_.size() && forces_of_all.size() == rows_.size());
  Report report;
  if (!begin(terms, laws, residual, d, forces_of_all)) return report;
  const Points at_start = forces();
  AndersonAcceleration acceleration(anderson_depth);
  double first = 0;
  while (report.sweeps < stop.most_sweeps) {
    const Points before = forces();
    const Vec2 largest = visit_all();
    if (report.sweeps++ == 0) first = largest[0];
    const Tolerance& tolerance = report.many_changes ? stop.many_changes : stop.quiet;
    report.settled = largest[0] <= tolerance.force && largest[1] <= tolerance.gap &&
                     (largest[0] <= stop.negligible || largest[0] <= stop.reduction * first);
    if (report.sweeps <= 2 && has_many_changes(stop, at_start)) {
      report.many_changes = true;
      report.settled = report.settled && stop.quiet.force <= stop.many_changes.force;
    }
    const VectorXd moved = (forces() - before).reshaped();
    if (report.settled || !std::isfinite(acceleration.advance(moved, iterate_))) break;
  }
  report.settled = report.settled && iterate_.allFinite();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto force = forces().col(static_cast<Index>(r));
    assert(!report.settled || !rows_[r].acts ||
           (force[0] >= -rows_[r].tension && std::abs(force[1]) <= rows_[r].bound_under(force[0])));
    forces_of_all[rows_[r].contact] = {force[0], force[1]};
  }
  for (std::size_t k = 0; k < unknown_.size(); ++k)
    if (unknown_[k] >= 0) d[unknown_[k]] += change()[k];
  return report;
}

}  // namespace ddacontact
