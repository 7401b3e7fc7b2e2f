#include <tests/performance/work_precision/reference.hpp>

#include <tests/performance/work_precision/deal_ii_run.hpp>
#include <tests/performance/work_precision/meshes.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace work_precision {
namespace {

/// Denser at 0 and, if `both`, at 1.
double graded(double t, bool both) {
  return both ? 0.5 - 0.5 * std::cos(std::numbers::pi * t) : t * t;
}

Problem graded_problem(const Problem& problem) {
  Problem result = problem;
  result.map = [low = problem.low, size = polyfem::Vec2(problem.high - problem.low),
                map = problem.map](const polyfem::Vec2& x) {
    const polyfem::Vec2 t = (x - low).cwiseQuotient(size);
    return map(low + polyfem::Vec2(graded(t.x(), false), graded(t.y(), true)).cwiseProduct(size));
  };
  return result;
}

double extrapolated(double a, double b, double c) {
  return c - (c - b) * (c - b) / ((c - b) - (b - a));
}

Reference compute(const Problem& problem) {
  const Problem graded = graded_problem(problem);
  std::array<Accuracy, 3> series;
  int n_rows = 24;
  for (Accuracy& accuracy : series) {
    const polyfem::PolygonMesh mesh = make_mesh(graded, Cells::quadrilaterals, n_rows);
    accuracy = run_deal_ii(graded, mesh, DealIIElement::q2, false).accuracy;
    n_rows *= 2;
  }
  const auto limit = [&](double Accuracy::*value) {
    return extrapolated(series[0].*value, series[1].*value, series[2].*value);
  };
  Reference reference;
  reference.watched = limit(&Accuracy::watched);
  reference.work = limit(&Accuracy::work);
  reference.watched_uncertainty = std::abs(series[2].watched / reference.watched - 1);
  reference.work_uncertainty = std::abs(series[2].work / reference.work - 1);
  std::printf(
      "Limits of %s: displacement %.7g and work %.7g, from which the finest of the three meshes is %.0e and "
      "%.0e away.\n",
      problem.name.c_str(), reference.watched, reference.work, reference.watched_uncertainty,
      reference.work_uncertainty);
  return reference;
}

}  // namespace

const Reference& reference_for(const Problem& problem) {
  static std::map<std::string, Reference> known;
  const auto [place, is_new] = known.try_emplace(problem.name);
  if (is_new) place->second = compute(problem);
  return place->second;
}

void compare_with_reference(const Problem& problem, Accuracy& accuracy) {
  const Reference& reference = reference_for(problem);
  accuracy.l2 = std::abs(accuracy.watched / reference.watched - 1);
  accuracy.energy = std::sqrt(std::abs(1 - accuracy.work / reference.work));
}

}  // namespace work_precision
