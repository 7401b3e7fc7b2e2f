// The suite of basis properties finds what it is for: for each property, bases with one fault that it must
// find.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/testing/basis_properties.hpp>

#include <iostream>

using namespace polyfem;

namespace {

/// Something done to the functions of a basis.
using Fault = void (*)(const PointsRef& polygon, const PointsRef& points, ShapeTable& table);
using FindRejection = std::optional<Rejection> (*)(const PointsRef& polygon);

std::optional<Rejection> object_to_concave(const PointsRef& polygon) {
  return wachspress.find_rejection(polygon);
}

struct FaultyBasis final : Basis {
  std::string_view name() const override { return "faulty"; }
  std::optional<Rejection> find_rejection(const PointsRef& polygon) const override {
    return object_to(polygon);
  }
  void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const override {
    wachspress.evaluate(polygon, points, table);
    fault(polygon, points, table);
  }
  Fault fault = nullptr;
  FindRejection object_to = object_to_concave;
};

/// The one under trial.
struct FaultyPromises {
  static FaultyBasis& faulty_basis() {
    static FaultyBasis basis;
    return basis;
  }
  static const Basis& basis() { return faulty_basis(); }
  static BasisPromises promises() { return {.tolerance = 1e-13, .affine = true}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Faulty, BasisProperties, FaultyPromises);

/// c with sum c_i = 0 and sum c_i v_i = 0: added to N it does no harm to linear fields.
Eigen::RowVectorXd harmless(const PointsRef& polygon) {
  Eigen::RowVectorXd c = Eigen::RowVectorXd::Zero(polygon.cols());
  if (polygon.cols() < 4) return c;
  const auto area = [&](Index i, Index j, Index k) {
    return cross(polygon.col(j) - polygon.col(i), polygon.col(k) - polygon.col(i));
  };
  c.head<4>() << area(1, 2, 3), -area(2, 3, 0), area(3, 0, 1), -area(0, 1, 2);
  return c / c.cwiseAbs().maxCoeff();
}

/// Adds a function to N that harms neither linear fields nor those on edges.
void add_bubble(double size, const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  for (Index q = 0; q < points.cols(); ++q) {
    double product = size;
    for (Index k = 0; k < polygon.cols(); ++k)
      product *= table.values(q, k) * static_cast<double>(polygon.cols());
    table.values.row(q) += product * harmless(polygon);
  }
}

void gradient_too_long(const PointsRef&, const PointsRef&, ShapeTable& table) {
  table.dx *= 1 + 1e-10;
}
void gradient_sum_off(const PointsRef& polygon, const PointsRef&, ShapeTable& table) {
  table.dx.col(0).array() += 1e-9 / (polygon.col(1) - polygon.col(0)).norm();
}
void gradient_of_another(const PointsRef& polygon, const PointsRef&, ShapeTable& table) {
  table.dx.rowwise() += 1e-6 * table.dx.cwiseAbs().maxCoeff() * harmless(polygon);
}
void gradient_without_edge_slope(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  for (Index q = 0; q < points.cols(); ++q)
    if (distance_to_boundary(polygon, points.col(q)) < 1e-15) table.dx.row(q) += 1e-9 * harmless(polygon);
}
void gradient_unsteady_at_edges(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  for (Index q = 0; q < points.cols(); ++q)
    table.dx.row(q) +=
        1e-14 / std::max(distance_to_boundary(polygon, points.col(q)), 1e-13) * harmless(polygon);
}
void no_number_on_edges(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  for (Index q = 0; q < points.cols(); ++q)
    if (distance_to_boundary(polygon, points.col(q)) == 0) table.dx.row(q).setConstant(std::nan(""));
}
void values_sum_off(const PointsRef&, const PointsRef&, ShapeTable& table) {
  table.values.col(0).array() += 1e-11;
}
void values_exchanged(const PointsRef&, const PointsRef&, ShapeTable& table) {
  table.values.col(0).array() += 1e-11;
  table.values.col(1).array() -= 1e-11;
}
void values_at_vertices_off(const PointsRef& polygon, const PointsRef&, ShapeTable& table) {
  table.values.rowwise() += 1e-11 * harmless(polygon);
}
void absolute_tolerance(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  for (Index q = 0; q < points.cols(); ++q)
    if (distance_to_boundary(polygon, points.col(q)) < 1e-7) table.values.row(q).setZero();
}
void single_precision(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  wachspress.evaluate(polygon.cast<float>().cast<double>(), points, table);
}
void knows_the_origin(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  add_bubble(1e-9 * std::cos(polygon(0, 0)), polygon, points, table);
}
void knows_the_axes(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  add_bubble(1e-9 * (polygon.col(1) - polygon.col(0)).normalized().x(), polygon, points, table);
}
void knows_the_size(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  add_bubble(1e-9 / (1 + (polygon.col(1) - polygon.col(0)).norm()), polygon, points, table);
}
void knows_the_first_vertex(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  add_bubble(1e-9, polygon, points, table);
}
void knows_other_points(const PointsRef&, const PointsRef& points, ShapeTable& table) {
  if (points.cols() > 1) table.values(1, 0) = std::nextafter(table.values(1, 0), 2);
}
void loses_short_edges(const PointsRef& polygon, const PointsRef&, ShapeTable& table) {
  table.values.col(0).array() += 1e-16 / (polygon.col(3 % polygon.cols()) - polygon.col(2)).squaredNorm();
}
void loses_straight_corners(const PointsRef& polygon, const PointsRef&, ShapeTable& table) {
  const double turn = cross(polygon.col(1) - polygon.col(0), polygon.col(2) - polygon.col(1));
  table.values.col(0).array() += 1e-18 / (turn * turn);
}
void allocates(const PointsRef&, const PointsRef&, ShapeTable& table) {
  MatrixXd elsewhere = table.dx;
  table.dx.swap(elsewhere);
}

void none(const PointsRef&, const PointsRef&, ShapeTable&) {}
std::optional<Rejection> object_to_nothing(const PointsRef&) {
  return std::nullopt;
}
std::optional<Rejection> object_to_everything(const PointsRef&) {
  return Rejection{0, "is bad"};
}
void mean_value_functions(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  mean_value.evaluate(polygon, points, table);
}

struct Trial {
  const char* property;
  Fault fault;
  FindRejection object_to = object_to_concave;
};

const Trial trials[] = {
    {"HasANameAndRejectsNothingThatItIsFor", none, object_to_everything},
    {"RejectsOtherPolygonsOrIsRightThere", none, object_to_nothing},
    {"ValuesSumToOne", values_sum_off},
    {"ValuesReproduceThePosition", values_exchanged},
    {"ValuesReproduceThePosition", single_precision},
    {"GradientsSumToZero", gradient_sum_off},
    {"GradientsReproduceTheIdentity", gradient_too_long},
    {"GradientsReproduceTheIdentity", no_number_on_edges},
    {"IsOneAtItsVertexAndZeroAtTheOthers", values_at_vertices_off},
    {"IsLinearAlongEdges", gradient_without_edge_slope},
    {"TendsFromInsideToWhatItIsOnTheEdge", gradient_unsteady_at_edges},
    {"GradientsAreTheDifferencesOfTheValues", gradient_of_another},
    {"FollowsTranslations", knows_the_origin},
    {"FollowsTurnsAndReflections", knows_the_axes},
    {"FollowsChangesOfScale", knows_the_size},
    {"FollowsChangesOfScale", absolute_tolerance},
    {"FollowsAffineMapsIfItPromisesTo", mean_value_functions},
    {"DoesNotDependOnWhichVertexIsTheFirst", knows_the_first_vertex},
    {"StandsTinyEdges", loses_short_edges},
    {"StandsNearlyStraightCorners", loses_straight_corners},
    {"OnePointAloneIsTheSameAsAmongMany", knows_other_points},
    {"ReusesTheStorageOfTheTable", allocates},
};

bool is_found(const Trial& trial) {
  FaultyPromises::faulty_basis().fault = trial.fault;
  FaultyPromises::faulty_basis().object_to = trial.object_to;
  GTEST_FLAG_SET(filter, std::string("*.") + trial.property);
  return RUN_ALL_TESTS() != 0;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());

  if (is_found({"*", none})) {
    std::cout << "a basis without fault fails\n";
    return 1;
  }
  int n_missed = 0;
  for (const Trial& trial : trials)
    if (!is_found(trial)) {
      std::cout << "fault " << &trial - trials << " is not found by " << trial.property << '\n';
      ++n_missed;
    }
  std::cout << std::size(trials) << " faults, " << n_missed << " of them not found\n";
  return n_missed == 0 ? 0 : 1;
}
