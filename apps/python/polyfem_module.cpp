#include "array_views.hpp"
#include "module.hpp"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

#include <cmath>
#include <string>

namespace polydda_python {

namespace py = pybind11;
using namespace polyfem;

namespace {

/// Values (q, n) and gradients (q, n, 2).
py::tuple evaluate(const Basis& basis, const PointArray& vertices, const PointArray& points) {
  const Points polygon = points_of(vertices, "vertices");
  require_usable(polygon);
  require_suitable(basis, polygon);
  ShapeTable table;
  basis.evaluate(polygon, points_of(points, "points"), table);
  py::array_t<double> values({table.n_points(), table.n_vertices()});
  py::array_t<double> gradients({table.n_points(), table.n_vertices(), Index{2}});
  auto value = values.mutable_unchecked<2>();
  auto gradient = gradients.mutable_unchecked<3>();
  for (Index q = 0; q < table.n_points(); ++q)
    for (Index i = 0; i < table.n_vertices(); ++i) {
      value(q, i) = table.values(q, i);
      gradient(q, i, 0) = table.dx(q, i);
      gradient(q, i, 1) = table.dy(q, i);
    }
  return py::make_tuple(values, gradients);
}

TabulatedElement element_on(const PointsRef& polygon, double tolerance) {
  TabulatedElement element;
  const ToleranceReport report =
      tabulate_to_tolerance(polygon, suitable_basis(polygon), tolerance, GradientCorrection::on, element);
  if (!report.met) throw Error("no rule reaches the tolerance on this polygon: ask for a larger one");
  return element;
}

Plane plane_of(const std::string& word) {
  if (word == "strain") return Plane::strain;
  if (word == "stress") return Plane::stress;
  throw py::value_error("plane is \"" + word + "\": write \"strain\" or \"stress\"");
}

MatrixXd stiffness_of(const PointArray& vertices, double young, double poisson, const std::string& plane,
                      double tolerance) {
  MatrixXd K;
  stiffness(element_on(points_of(vertices, "vertices"), tolerance),
            elasticity_matrix(young, poisson, plane_of(plane)), K);
  return K;
}

MatrixXd mass_of(const PointArray& vertices, double density, double tolerance) {
  if (!(density >= 0) || !std::isfinite(density))
    throw Error("density is " + std::to_string(density) + " kg/m3 but must be finite and not negative");
  MatrixXd M;
  mass(element_on(points_of(vertices, "vertices"), tolerance), M);
  return density * M;
}

py::tuple rule_on(const PointArray& vertices, int degree) {
  const Points polygon = points_of(vertices, "vertices");
  require_usable(polygon);
  PolygonRule rule;
  make_polygon_rule(polygon, dunavant_rule(degree), rule);
  return py::make_tuple(copy(rule.points), rule.weights);
}

py::tuple voronoi_of(const PointArray& boundary, int cells, std::uint64_t seed) {
  const PolygonMesh mesh = voronoi(points_of(boundary, "boundary"), {.n_cells = cells, .seed = seed});
  py::list lists;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto cell = mesh.cell(c);
    lists.append(std::vector<int>(cell.begin(), cell.end()));
  }
  return py::make_tuple(copy(mesh.vertices), lists);
}

/// A FieldProblem that owns its mesh.
class Problem {
 public:
  Problem(const PointArray& vertices, const std::vector<std::vector<int>>& cells, int n_components)
      : n_components_(n_components), mesh_(mesh_of(vertices, cells)), problem_(mesh_, n_components) {}
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  void assemble(double young, double poisson, const Vec2& body, const std::string& plane, double tolerance) {
    if (n_components_ != 2)
      throw Error("assemble is of elasticity, whose field has two components, and this one has " +
                  std::to_string(n_components_) +
                  ": make Problem(..., components=2), or assemble_cells for another equation");
    const Mat3 D = elasticity_matrix(young, poisson, plane_of(plane));
    problem_.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd& f) {
      const TabulatedElement element = element_on(cell, tolerance);
      stiffness(element, D, K);
      polyfem::body_force(element, body, f);
    });
  }
  void assemble_cells(
      const std::function<std::pair<MatrixXd, VectorXd>(int, const py::array&)>& cell_matrix) {
    problem_.assemble([&](int c, const PointsRef& cell, MatrixXd& K, VectorXd& f) {
      std::tie(K, f) = cell_matrix(c, copy(cell));
    });
  }
  void hold(int vertex, int component, double value) { problem_.hold(vertex, component, value); }
  void add_load(int vertex, int component, double value) { problem_.add_load(vertex, component, value); }
  py::array solve() { return by_vertex(problem_.solve()); }
  py::array reactions() const { return by_vertex(problem_.reactions()); }

 private:
  static PolygonMesh mesh_of(const PointArray& vertices, const std::vector<std::vector<int>>& cells) {
    PolygonMesh mesh;
    mesh.vertices = points_of(vertices, "vertices");
    for (const std::vector<int>& cell : cells) mesh.add_cell(cell);
    return mesh;
  }
  /// A row a vertex, a column a component.
  py::array by_vertex(const VectorXd& field) const {
    const py::ssize_t n_vertices = mesh_.vertices.cols();
    py::array_t<double> array({n_vertices, static_cast<py::ssize_t>(field.size()) / n_vertices});
    std::copy(field.begin(), field.end(), array.mutable_data());
    return array;
  }

  int n_components_;
  PolygonMesh mesh_;
  FieldProblem problem_;
};

}  // namespace

void add_polyfem(py::module_& module) {
  py::module_ polyfem = module.def_submodule("polyfem");
  polyfem.def(
      "wachspress", [](const PointArray& v, const PointArray& x) { return evaluate(wachspress, v, x); },
      py::arg("vertices"), py::arg("points"));
  polyfem.def(
      "mean_value", [](const PointArray& v, const PointArray& x) { return evaluate(mean_value, v, x); },
      py::arg("vertices"), py::arg("points"));
  polyfem.def("stiffness", &stiffness_of, py::arg("vertices"), py::arg("young"), py::arg("poisson"),
              py::arg("plane") = "strain", py::arg("tolerance") = 1e-6);
  polyfem.def("mass", &mass_of, py::arg("vertices"), py::arg("density"), py::arg("tolerance") = 1e-6);
  polyfem.def("rule", &rule_on, py::arg("vertices"), py::arg("degree"));
  polyfem.def("voronoi", &voronoi_of, py::arg("boundary"), py::arg("cells"), py::arg("seed") = 1);
  py::class_<Problem>(polyfem, "Problem")
      .def(py::init<const PointArray&, const std::vector<std::vector<int>>&, int>(), py::arg("vertices"),
           py::arg("cells"), py::arg("components") = 2)
      .def("assemble", &Problem::assemble, py::arg("young"), py::arg("poisson"), py::arg("body_force"),
           py::arg("plane"), py::arg("tolerance"))
      .def("assemble_cells", &Problem::assemble_cells, py::arg("cell_matrix"))
      .def("hold", &Problem::hold, py::arg("vertex"), py::arg("component"), py::arg("value") = 0.0)
      .def("add_load", &Problem::add_load, py::arg("vertex"), py::arg("component"), py::arg("value"))
      .def("solve", &Problem::solve)
      .def("reactions", &Problem::reactions);
}

}  // namespace polydda_python
