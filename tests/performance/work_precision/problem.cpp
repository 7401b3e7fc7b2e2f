#include <tests/performance/work_precision/problem.hpp>

#include <cmath>
#include <numbers>

using namespace polyfem;
using support::ElasticSolution;

namespace work_precision {
namespace {

Problem exact_problem(std::string name, const Vec2& low, const Vec2& high, ElasticSolution solution) {
  Problem problem;
  problem.name = std::move(name);
  problem.low = low;
  problem.high = high;
  problem.map = [](const Vec2& x) { return x; };
  problem.traction = [stress = solution.stress](const Vec2& x, const Vec2& n) {
    return support::traction(stress(x), n);
  };
  problem.solution = std::move(solution);
  return problem;
}

Problem manufactured() {
  Problem problem = exact_problem("manufactured", {0, 0}, {1, 1}, support::manufactured_solution(1, 0.3));
  problem.boundary = [](const Vec2&) { return Boundary{true, true, false}; };
  problem.perturbation = 0.15;
  return problem;
}

/// A quarter of the plate out to four radii, the image of a rectangle under exp: squares stay nearly square.
/// The exact tractions act on the straight edges, so that the body is the mesh and its shape brings no error.
Problem plate_with_hole() {
  const double r = 4;
  Problem problem = exact_problem("plate with a hole", {0, 0}, {std::log(r), std::numbers::pi / 2},
                                  support::hole_solution(1, 0.3, 1, 1));
  problem.map = [](const Vec2& x) { return Vec2(std::exp(x.x()) * Vec2(std::cos(x.y()), std::sin(x.y()))); };
  problem.boundary = [](const Vec2& x) {
    const bool on_x_axis = x.y() < 1e-9, on_y_axis = x.x() < 1e-9;
    return Boundary{on_y_axis, on_x_axis, !on_x_axis && !on_y_axis};
  };
  return problem;
}

Problem cook() {
  Problem problem;
  problem.name = "Cook";
  problem.low = {0, 0};
  problem.high = {48, 44};
  problem.map = [](const Vec2& x) {
    const double bottom = 44 * x.x() / 48, top = 44 + 16 * x.x() / 48;
    return Vec2(x.x(), bottom + (top - bottom) * x.y() / 44);
  };
  problem.solution.poisson = 1. / 3;
  problem.solution.plane = Plane::stress;
  problem.boundary = [](const Vec2& x) {
    const bool left = x.x() < 1e-9;
    return Boundary{left, left, x.x() > 48 - 1e-9};
  };
  problem.traction = [](const Vec2&, const Vec2&) { return Vec2(0, 1. / 16); };
  problem.watched = {48, 52};
  return problem;
}

}  // namespace

Problem cantilever(double poisson) {
  constexpr double length = 8, height = 4;
  Problem problem =
      exact_problem(poisson > 0.49 ? "nearly incompressible" : "cantilever", {0, -height / 2},
                    {length, height / 2}, support::cantilever_solution(1, poisson, length, height, -1));
  problem.boundary = [](const Vec2& x) {
    const bool left = x.x() < 1e-9;
    return Boundary{left, left, x.x() > length - 1e-9};
  };
  problem.nearly_incompressible = poisson > 0.49;
  return problem;
}

std::vector<Problem> all_problems() {
  return {manufactured(), cantilever(0.3), cook(), plate_with_hole(), cantilever(0.4999)};
}

}  // namespace work_precision
