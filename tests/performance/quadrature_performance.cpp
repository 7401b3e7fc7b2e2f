// How accurate K and M are with how many points and in what time:
//
//   quadrature_performance rules [N]       CSV: each rule on N random convex polygons of 3 .. 12 vertices
//   (default 100) quadrature_performance tolerance [N]   CSV: requested tolerances on N random convex
//   polygons and N cells of random
//                                          sites with all their short edges (default 5000 each)
//
// Errors are relative, in the Frobenius norm, against a much finer rule, whose difference from a still finer
// one goes to the error output. K is that of plane strain, E = 1, nu = 0.3, gradients corrected. Times are
// the median of one element over the polygons, from the polygon to the table of shape functions; K and M are
// not in it.

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

using namespace polyfem;

namespace {

constexpr auto on = GradientCorrection::on;

struct Matrices {
  MatrixXd K, M;
};

Matrices matrices_of(const TabulatedElement& element) {
  Matrices matrices;
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), matrices.K);
  mass(element, matrices.M);
  return matrices;
}

Matrices reference(const Points& polygon, double digits) {
  PolygonRule rule;
  TabulatedElement element;
  make_adjoint_rule(polygon, digits, rule);
  tabulate(polygon, rule, wachspress, on, element);
  return matrices_of(element);
}

double relative(const MatrixXd& matrix, const MatrixXd& exact) {
  return (matrix - exact).norm() / exact.norm();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

struct Sample {
  std::vector<Points> cells;
  std::vector<Matrices> exact;

  void add(const Points& cell) {
    cells.push_back(cell);
    exact.push_back(reference(cell, 40));
  }
  void report_reference(const std::string& name) const {
    double K = 0, M = 0;
    for (std::size_t i = 0; i < cells.size(); i += 7) {
      const Matrices finer = reference(cells[i], 44);
      K = std::max(K, relative(exact[i].K, finer.K));
      M = std::max(M, relative(exact[i].M, finer.M));
    }
    std::fprintf(stderr, "reference for %s: %.1e of K, %.1e of M against a finer one\n", name.c_str(), K, M);
  }
};

using Tabulation = std::function<void(const Points&, TabulatedElement&)>;

struct Measured {
  std::vector<double> n_points, K_error, M_error, microseconds;
};

Measured measure(const Sample& sample, const Tabulation& tabulation) {
  using Clock = std::chrono::steady_clock;
  Measured measured;
  TabulatedElement element;
  tabulation(sample.cells.front(), element);  // makes the tables
  for (std::size_t i = 0; i < sample.cells.size(); ++i) {
    std::vector<double> times;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const Clock::time_point start = Clock::now();
      tabulation(sample.cells[i], element);
      times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    const Matrices matrices = matrices_of(element);
    measured.n_points.push_back(static_cast<double>(element.n_points()));
    measured.K_error.push_back(relative(matrices.K, sample.exact[i].K));
    measured.M_error.push_back(relative(matrices.M, sample.exact[i].M));
    measured.microseconds.push_back(median(times));
  }
  return measured;
}

void print_rule(int n, const std::string& name, const Measured& m) {
  std::printf("%d,%s,%.0f,%.0f,%.3e,%.3e,%.3e,%.3e,%.2f\n", n, name.c_str(), median(m.n_points),
              largest(m.n_points), median(m.K_error), largest(m.K_error), median(m.M_error),
              largest(m.M_error), median(m.microseconds));
}

Tabulation by_triangles(const TriangleRule& rule) {
  return [rule](const Points& polygon, TabulatedElement& element) {
    tabulate(polygon, rule, wachspress, on, element);
  };
}

Tabulation by_gauss(int n_gauss) {
  return [n_gauss](const Points& polygon, TabulatedElement& element) {
    PolygonRule rule;
    make_quadrilateral_rule(polygon, n_gauss, rule);
    tabulate(polygon, rule, wachspress, on, element);
  };
}

Tabulation to_tolerance(double tolerance) {
  return [tolerance](const Points& polygon, TabulatedElement& element) {
    tabulate_to_tolerance(polygon, wachspress, tolerance, on, element);
  };
}

void measure_rules(int n_cells) {
  std::puts("n,rule,points_median,points_max,K_median,K_max,M_median,M_max,microseconds");
  std::mt19937 random(1);
  for (int n = 3; n <= 12; ++n) {
    Sample sample;
    for (int i = 0; i < n_cells; ++i) sample.add(support::random_convex_polygon(n, random));
    sample.report_reference("n = " + std::to_string(n));
    print_rule(n, "Hammer 4 points", measure(sample, by_triangles(hammer_rule(3))));
    for (const int degree : {2, 5, 8, 12, 16, 20})
      print_rule(n, "symmetric degree " + std::to_string(degree),
                 measure(sample, by_triangles(dunavant_rule(degree))));
    for (const int grading : {1, 2, 3})
      for (const int m : {4, 8, 12, 16, 24})
        print_rule(n, "collapsed Gauss " + std::to_string(m) + " grading " + std::to_string(grading),
                   measure(sample, by_triangles(collapsed_gauss_rule(m, m, grading))));
    if (n == 4)
      for (const int m : {2, 3, 4, 6, 8, 12})
        print_rule(n, "bilinear Gauss " + std::to_string(m), measure(sample, by_gauss(m)));
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      char name[32];
      std::snprintf(name, sizeof name, "to tolerance %.0e", tolerance);
      print_rule(n, name, measure(sample, to_tolerance(tolerance)));
    }
  }
}

void measure_tolerance(const std::string& name, const Sample& sample) {
  sample.report_reference(name);
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const Measured m = measure(sample, to_tolerance(tolerance));
    int n_reported = 0, n_missed = 0;
    std::vector<double> overestimates;
    TabulatedElement element;
    for (std::size_t i = 0; i < sample.cells.size(); ++i) {
      const double error = std::max(m.K_error[i], m.M_error[i]);
      const ToleranceReport report =
          tabulate_to_tolerance(sample.cells[i], wachspress, tolerance, on, element);
      if (!report.met) ++n_reported;
      if (error > tolerance) ++n_missed;
      if (sample.cells[i].cols() > 3)
        overestimates.push_back(std::max(report.error.stiffness, report.error.mass) / error);
    }
    std::sort(overestimates.begin(), overestimates.end());
    const auto quantile = [&](double q) {
      return overestimates[static_cast<std::size_t>(q * double(overestimates.size()))];
    };
    std::printf("%s,%.0e,%zu,%d,%d,%.0f,%.0f,%.2e,%.2e,%.2e,%.2e,%.1f,%.1f,%.1f,%.1f\n", name.c_str(),
                tolerance, sample.cells.size(), n_missed, n_reported, median(m.n_points), largest(m.n_points),
                median(m.K_error), largest(m.K_error), median(m.M_error), largest(m.M_error), quantile(0.01),
                quantile(0.5), quantile(0.99), median(m.microseconds));
  }
}

void measure_tolerances(int n_cells) {
  std::puts(
      "cells,tolerance,n_cells,missed,reported_unmet,points_median,points_max,K_median,K_max,M_median,M_max,"
      "estimate_over_error_1%,50%,99%,microseconds");
  std::mt19937 random(2);
  Sample polygons, cells;
  for (int i = 0; i < n_cells; ++i) polygons.add(support::random_convex_polygon(3 + i % 10, random));
  measure_tolerance("random convex polygons", polygons);

  Points square(2, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1;
  VoronoiOptions options;
  options.n_cells = n_cells;
  options.lloyd_steps = 0;
  options.smallest_edge = 0;
  const PolygonMesh mesh = voronoi(square, options);
  for (int c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell(c).size() <= 12) cells.add(mesh.outline(c));
  measure_tolerance("Voronoi cells of random sites", cells);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int n_cells = argc > 2 ? std::atoi(argv[2]) : 0;
  if (what == "rules") {
    measure_rules(n_cells > 0 ? n_cells : 100);
  } else if (what == "tolerance") {
    measure_tolerances(n_cells > 0 ? n_cells : 5000);
  } else {
    std::fputs("usage: quadrature_performance rules|tolerance [N]\n", stderr);
    return 2;
  }
}
