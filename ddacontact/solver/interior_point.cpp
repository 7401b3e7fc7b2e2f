#include <ddacontact/solver/interior_point.hpp>

#include <ddacontact/solver/interior_contact.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace ddacontact {

namespace {

/// Solutions while mu falls, and to find the path for one mu.
constexpr int most_solutions = 60;
/// Near: sqrt(mu) is this part of the largest sum of forces on a block, and what forces leave over on a block
/// that part of their sum. The states are told there when a solution changes none, and at this part of both.
constexpr double near_law = 1e-5, near_balance = 1e-2, nearer = 1e-4;
/// This part of the contacts does not shorten for the others how far a solution is followed.
constexpr double trimmed_part = 0.01;
/// mu falls to no less than the third power of this part of its mean.
constexpr double least_part = 1e-3;
/// The path begins with so many times more of mu where it is not found.
constexpr double more = 100;
/// The path is followed in steps that change no number by more than this part of itself: smaller ones where
/// it bends, and none below the shortest.
constexpr double longest_step = 0.9, shortest_step = 1e-3;
constexpr double step_growth = 1.5, step_cut = 0.25;
/// A point counts as one of the path where Newton's method changes no number by more than this part of
/// itself. Where it asks for much more, or does not get there in so many solutions, the step was too long.
constexpr double near_path = 0.5, far_from_path = 10;
constexpr int most_corrections = 4;
/// Values of mu for which the path is looked for, and solutions to follow it.
constexpr int most_path_starts = 5, most_path_solutions = 600;
/// See find_interior_point_states.
struct InteriorPoint : EvaluatedContacts {
  StepProblem& system;
  VectorXd& d;
  std::vector<InteriorContact> inside{terms.size()};
  std::vector<ContactForce> forces{terms.size()};
  std::vector<unsigned char> active = std::vector<unsigned char>(terms.size());
  std::vector<Coupling> couplings{};
  std::vector<unsigned char> states{};  ///< told last
  double scale = 0;                     ///< the largest sum of forces on a block
  Residual residual{};
  VectorXd rhs{}, correction{};
  InteriorReport report{};

  InteriorReport solve() {
    if (!let_mu_fall() && report.found) follow_path();
    return report;
  }

  /// Mehrotra's method. False: mu does not fall far enough.
  bool let_mu_fall() {
    evaluate();
    assert(laws.size() == contacts.size() && terms.size() == contacts.size() && d.allFinite());
    for (std::size_t c = 0; c < inside.size(); ++c) forces[c] = {terms[c].normal_multiplier, laws[c].shear};
    system.compute_residual(d, contacts, terms, forces, residual);
    scale = residual.scale;
    evaluate_interior(scale * scale);
    system.problem().order_for_many(terms);
    while (report.solutions < most_solutions) {
      balance();
      const double mean = mean_product(0);
      report.found = std::isfinite(mean) && std::isfinite(residual.block_relative);
      if (report.found && tells_states(way_left(mean))) return true;
      report.found = report.found && factorize();
      if (!report.found) return false;
      const double mu = find_direction(mean);
      ++report.solutions;
      advance(longest(trimmed_part));
      evaluate();
      evaluate_interior(mu);
    }
    return false;
  }

  /// What is left of mu and of forces, 1: near.
  double way_left(double mean) const {
    return std::max(std::sqrt(mean) / (near_law * scale), residual.block_relative / near_balance);
  }

  /// Whether the states can be told where so much of the way is left.
  bool tells_states(double way) {
    const std::vector<unsigned char> before = std::exchange(states, {});
    for (std::size_t c = 0; c < inside.size(); ++c) states.push_back(inside[c].state(laws[c]));
    return way <= nearer || (way <= 1 && states == before);
  }

  /// A point of the path, with the direction in which it was reached.
  struct PathPoint {
    std::vector<InteriorContact> inside;
    VectorXd d;
    std::vector<double> direction;
  };

  /// Where the path leads from here: C to the point of it where mu is the mean of the products, and C + D to
  /// its end, by Newton's method. Both as parts of themselves by which the numbers change, mu the last one.
  struct PathStep {
    std::vector<InteriorContact> centred;  ///< with C
    VectorXd correction;                   ///< for it
    std::vector<double> C, D;
    double nearest = 0;   ///< C + nearest * D leads to the nearest point of the path
    double off = 0;       ///< the largest part of that
    double steepest = 0;  ///< the largest part in D
  };

  /// Follows the path of the points where all products are mu, from large mu on, where it is easily found, to
  /// its end, whether mu falls or rises on the way: where friction is large there are several solutions, and
  /// the path turns round between them, where Newton's method for a smaller mu leads nowhere.
  void follow_path() {
    const int last = report.solutions + most_path_solutions;
    bool on_path = false;
    int n_starts = 0, n_corrections = most_solutions;
    double longest_now = longest_step, step = longest_step, first = 0;
    PathPoint kept;
    while (report.solutions < last) {
      if (!on_path && n_corrections == most_solutions) {
        if (n_starts == most_path_starts) return;
        first = std::pow(more, n_starts++) * scale * scale;
        begin_all(first);
        n_corrections = 0;
      }
      balance();
      const double mean = mean_product(0), way = way_left(mean);
      if (on_path && mean > more * first) {  // a step went over to another branch, and that leads back
        longest_now /= 2;
        step = longest_now;
        on_path = false;
        n_corrections = most_solutions;
        kept.direction.clear();
        continue;
      }
      if (on_path && tells_states(way)) return;
      PathStep path;
      path.off = inf;
      if (std::isfinite(mean) && std::isfinite(residual.block_relative) && factorize())
        path = look_along_path(mean);
      ++report.solutions;
      const bool reached = path.off <= near_path;
      if (on_path && !reached && (!(path.off <= far_from_path) || n_corrections == most_corrections)) {
        step *= step_cut;
        if (step < shortest_step) return;
        return_to(kept);
        n_corrections = -1;
        continue;
      }
      if (!on_path && !std::isfinite(path.off)) {
        n_corrections = most_solutions;
        continue;
      }
      double part = on_path ? path.nearest : 0;
      if (reached) {
        on_path = true;
        const double sense = keep_direction(kept.direction, path.D);
        if (n_corrections == 0) step = std::min(step * step_growth, longest_now);
        part = path.nearest + sense * step / std::max(1.0, path.steepest);
        kept = {inside, d, std::move(path.D)};
        n_corrections = 0;
      } else {
        ++n_corrections;
      }
      combine(path, part);
      advance(std::min(1.0, longest()));
      evaluate();
      evaluate_interior(mean);
    }
  }

  void return_to(const PathPoint& point) {
    inside = point.inside;
    d = point.d;
    evaluate();
  }

  /// Turns a direction that leads back from where one came. Returns what it was multiplied by.
  static double keep_direction(const std::vector<double>& before, std::vector<double>& direction) {
    const double along = std::inner_product(before.begin(), before.end(), direction.begin(), 0.0),
                 sense = along < 0 ? -1 : 1;
    for (double& change : direction) change *= sense;
    return sense;
  }

  /// From the start of the step, with these products.
  void begin_all(double mu) {
    d = system.prescribed();
    evaluate();
    for (InteriorContact& i : inside) i = {};
    evaluate_interior(mu);
  }

  PathStep look_along_path(double mean) {
    PathStep path;
    solve_for(mean, 0);
    path.centred = inside;
    path.correction = correction;
    path.C = relative_changes();
    path.C.push_back(0);
    solve_for(0, 0);
    path.D = relative_changes();
    path.D.push_back(-1);
    double CD = 0, DD = 0;
    for (std::size_t k = 0; k < path.D.size(); ++k) {
      path.D[k] -= path.C[k];
      CD += path.C[k] * path.D[k];
      DD += path.D[k] * path.D[k];
      path.steepest = std::max(path.steepest, std::abs(path.D[k]));
    }
    path.nearest = -CD / DD;
    for (std::size_t k = 0; k < path.D.size(); ++k)
      path.off = std::max(path.off, std::abs(path.C[k] + path.nearest * path.D[k]));
    if (!std::isfinite(DD)) path.off = inf;
    return path;
  }

  /// Of the numbers of the pairs of each contact.
  std::vector<double> relative_changes() const {
    std::vector<double> changes;
    for (const InteriorContact& i : inside) {
      const auto append = [&](const InteriorPair& pair, bool acts) {
        changes.push_back(acts ? pair.dx / pair.x : 0);
        changes.push_back(acts ? pair.ds / pair.s : 0);
      };
      append(i.normal, i.acts && i.unilateral);
      append(i.upper, i.acts && i.slides());
      append(i.lower, i.acts && i.slides());
    }
    return changes;
  }

  /// Makes the solution C + part * D of that which leads to the end of the path.
  void combine(const PathStep& path, double part) {
    const auto between = [&](double centred, double& end) { end = centred + part * (end - centred); };
    for (std::size_t c = 0; c < inside.size(); ++c) {
      InteriorContact& i = inside[c];
      const InteriorContact& centred = path.centred[c];
      for (InteriorPair InteriorContact::*pair :
           {&InteriorContact::normal, &InteriorContact::upper, &InteriorContact::lower}) {
        between((centred.*pair).dx, (i.*pair).dx);
        between((centred.*pair).ds, (i.*pair).ds);
      }
      between(centred.dT, i.dT);
    }
    correction = path.correction + part * (correction - path.correction);
  }

  void evaluate_interior(double mu) {
    for (std::size_t c = 0; c < inside.size(); ++c) inside[c].evaluate(terms[c], laws[c], d, mu);
  }

  void balance() {
    for (std::size_t c = 0; c < inside.size(); ++c) {
      const InteriorContact& i = inside[c];
      forces[c] = i.acts ? ContactForce{i.N(), i.T} : ContactForce{};
    }
    system.compute_residual(d, contacts, terms, forces, residual);
  }

  double mean_product(double length) {
    double sum = 0;
    int n = 0;
    for (InteriorContact& i : inside)
      i.for_pairs([&](const InteriorPair& pair) {
        sum += (pair.x + length * pair.dx) * (pair.s + length * pair.ds);
        ++n;
      });
    return n == 0 ? 0 : sum / n;
  }

  /// The matrix with each spring as stiff as its contact's place between its bounds makes it.
  bool factorize() {
    system.linearize(d);
    system.problem().matrices_changed();
    couplings.clear();
    for (std::size_t c = 0; c < inside.size(); ++c) {
      InteriorContact& i = inside[c];
      active[c] = none_acts;
      if (!i.acts) continue;
      i.find_rates();
      terms[c].normal_stiffness = i.w * i.p;
      terms[c].tangential_stiffness = i.wt * i.p_t;
      active[c] = i.sheared ? all_act : normal_acts;
      if (i.mixed * i.rate != 0) couplings.push_back({c, i.mixed * i.rate * i.w * i.p});
    }
    return system.problem().factorize(terms, active, couplings);
  }

  /// As far as it looks that mu may fall, with what is known of the second order then. Returns mu; where no
  /// contact acts yet, that of the start.
  double find_direction(double mean) {
    solve_for(0, 0);
    if (mean == 0) return scale * scale;
    const double length = longest(), part = std::max(mean_product(length) / mean, least_part),
                 mu = mean * part * part * part;
    solve_for(mu, length);
    return mu;
  }

  /// Newton's method for balance and the contacts' equations.
  void solve_for(double mu, double second_order) {
    rhs = residual.force;
    for (std::size_t c = 0; c < inside.size(); ++c) {
      InteriorContact& i = inside[c];
      if (!i.acts) continue;
      i.aim(mu, second_order);
      terms[c].gap.add_gradient(-i.cN, rhs);
      if (i.sheared) terms[c].slip.add_gradient(-(i.cT + i.mixed * i.rate * i.cN), rhs);
    }
    system.problem().solve(rhs, correction);
    for (std::size_t c = 0; c < inside.size(); ++c) {
      InteriorContact& i = inside[c];
      if (!i.acts) continue;
      i.follow(terms[c].gap.change(correction), i.sheared ? terms[c].slip.change(correction) : 0);
    }
  }

  /// How far all contacts but this part of them may follow the solution.
  double longest(double trimmed = 0) {
    std::vector<double> lengths{1};
    for (InteriorContact& i : inside) lengths.push_back(i.longest());
    const auto first = lengths.begin() + static_cast<Index>(trimmed * static_cast<double>(lengths.size()));
    std::nth_element(lengths.begin(), first, lengths.end());
    return *first;
  }

  /// Each contact as far as it may: what that leaves over the next solution makes good.
  void advance(double longest_of_all) {
    for (InteriorContact& i : inside) i.advance(std::min(longest_of_all, i.longest()));
    if (correction.allFinite()) system.move(-longest_of_all * correction, d);
  }
};

}  // namespace

InteriorReport find_interior_point_states(StepProblem& system, const EvaluatedContacts& contacts, VectorXd& d,
                                          std::vector<unsigned char>& states) {
  InteriorPoint point{contacts, system, d};
  const InteriorReport report = point.solve();
  states.resize(contacts.terms.size());
  for (std::size_t c = 0; c < contacts.terms.size(); ++c) states[c] = point.inside[c].state(contacts.laws[c]);
  return report;
}

}  // namespace ddacontact
