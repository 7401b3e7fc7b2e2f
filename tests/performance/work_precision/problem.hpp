/// \file The boundary value problems that are solved by both sides.
#pragma once

#include <tests/support/elastic_solutions.hpp>

#include <functional>
#include <string>
#include <vector>

namespace work_precision {

/// What is known on an edge of the boundary; where no component is held the traction acts.
struct Boundary {
  bool fixed_x = false, fixed_y = false;
  bool loaded = false;  ///< the traction is not zero everywhere
  int number() const { return fixed_x + 2 * fixed_y + 4 * loaded; }
};

/// A body in plane strain or stress: the image of a rectangle, on which the meshes are made.
struct Problem {
  std::string name;
  polyfem::Vec2 low, high;                                 ///< of the rectangle
  std::function<polyfem::Vec2(const polyfem::Vec2&)> map;  ///< of the rectangle onto the body
  support::ElasticSolution solution;                       ///< without stress: unknown, see reference
  std::function<Boundary(const polyfem::Vec2&)> boundary;  ///< at the middle of an edge
  std::function<polyfem::Vec2(const polyfem::Vec2& x, const polyfem::Vec2& n)> traction;
  bool nearly_incompressible = false;  ///< the volumetric strain of a cell is measured by its mean
  polyfem::Vec2 watched{
      0, 0};                ///< the vertex whose vertical displacement is compared where no solution is known
  double perturbation = 0;  ///< of vertices inside, relative to the distance between them

  polyfem::Mat3 elasticity() const {
    return elasticity_matrix(solution.young, solution.poisson, solution.plane);
  }
  bool exact() const { return static_cast<bool>(solution.stress); }
};

/// The end-loaded beam of 8 x 4, held and loaded as its exact solution tells.
Problem cantilever(double poisson);

/// Manufactured, cantilever, Cook's membrane, plate with a hole, nearly incompressible cantilever.
std::vector<Problem> all_problems();

}  // namespace work_precision
