// Three polygons of a strip, held at the foot and pulled at the top.
//
//    t t t t t t       The strip, 2 m wide and 3 m high, is under sigma_yy = t and nothing else. In plane
//    ^ ^ ^ ^ ^ ^       strain that makes
//    5----4----3          eps_yy = t (1 - nu^2) / E,      eps_xx = -t nu (1 + nu) / E,
//    |  C |  B |          u_y(top) = 3 m eps_yy,          u_x(right side) = 2 m eps_xx.
//    |  _-7_   |
//    6-'    `--2       This field is linear in x and y, hence within reach of every element, and elements
//    |    A    |       that pass the patch test find it to round-off: Wachspress functions with corrected
//    0---------1       gradients do, with any quadrature.
//    ^         o       Node 0 is held in x and y, node 1 in y.
#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <cmath>
#include <iostream>

using namespace polyfem;

int main() {
  constexpr double young = 10e9, poisson = 0.25, traction = 2e6;
  Points nodes(2, 8);
  nodes << 0, 2, 2, 2, 1.1, 0, 0, 0.8,  //
      0, 0, 1.2, 3, 3, 3, 1.5, 1.7;
  const std::vector<std::vector<int>> elements{{0, 1, 2, 7, 6}, {2, 3, 4, 7}, {7, 4, 5, 6}};

  // Unknown 2 i + axis of node i has this equation; held ones have none (-1).
  std::vector<int> equation(16);
  int n_equations = 0;
  for (int k = 0; k < 16; ++k) equation[k] = k == 0 || k == 1 || k == 3 ? -1 : n_equations++;

  Connectivity connectivity;
  for (const std::vector<int>& element : elements) {
    std::vector<int> rows;
    for (int node : element) rows.insert(rows.end(), {equation[2 * node], equation[2 * node + 1]});
    connectivity.append(rows);
  }
  PatternMatrix K;
  K.set_connectivity(n_equations, connectivity);
  K.set_zero();
  const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);
  TabulatedElement element;
  MatrixXd element_matrix;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Points polygon = nodes(Eigen::all, elements[e]);
    tabulate(polygon, dunavant_rule(5), wachspress, GradientCorrection::on, element);
    stiffness(element, D, element_matrix);
    K.add(static_cast<int>(e), element_matrix);
  }

  VectorXd F = VectorXd::Zero(n_equations), d;
  for (const auto& [left, right] : {std::pair(5, 4), std::pair(4, 3)}) {  // half an edge's force to each end
    const double force = traction * (nodes(0, right) - nodes(0, left));
    for (int node : {left, right}) F[equation[2 * node + 1]] += force / 2;
  }
  Cholesky cholesky;
  cholesky.analyze(K.lower());
  if (!cholesky.factorize(K.lower())) return 1;
  cholesky.solve(F, d);

  const double top = d[equation[2 * 3 + 1]], exact_top = 3 * traction * (1 - poisson * poisson) / young;
  const double side = d[equation[2 * 3]], exact_side = -2 * traction * poisson * (1 + poisson) / young;
  std::cout << "top rises by " << top << " m, exactly " << exact_top << " m\nside moves by " << side
            << " m, exactly " << exact_side << " m\n";
  return std::abs(top / exact_top - 1) < 1e-12 && std::abs(side / exact_side - 1) < 1e-12 ? 0 : 1;
}
