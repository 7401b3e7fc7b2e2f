// The linear functions of a triangle, as a basis of somebody else's.
#include <polyfem/testing/basis_properties.hpp>

namespace {

class LinearTriangle final : public polyfem::Basis {
 public:
  std::string_view name() const override { return "linear_triangle"; }
  std::optional<polyfem::Rejection> find_rejection(const polyfem::PointsRef& polygon) const override {
    if (polygon.cols() == 3) return std::nullopt;
    return polyfem::Rejection{3, "is one too many: only triangles will do"};
  }
  void evaluate(const polyfem::PointsRef& polygon, const polyfem::PointsRef& points,
                polyfem::ShapeTable& table) const override {
    for (polyfem::MatrixXd* entries : {&table.values, &table.dx, &table.dy})
      entries->resize(points.cols(), 3);
    for (polyfem::Index q = 0; q < points.cols(); ++q) {
      const polyfem::Points from_x = polygon.colwise() - points.col(q);
      for (polyfem::Index i = 0; i < 3; ++i) {
        const polyfem::Vec2 a = from_x.col((i + 1) % 3), b = from_x.col((i + 2) % 3), edge = b - a;
        const double area = polyfem::cross(edge, from_x.col(i) - a);
        table.values(q, i) = polyfem::cross(a, b) / area;
        table.dx(q, i) = -edge.y() / area;
        table.dy(q, i) = edge.x() / area;
      }
    }
  }
};

struct LinearTrianglePromises {
  static const polyfem::Basis& basis() {
    static const LinearTriangle basis;
    return basis;
  }
  static polyfem::BasisPromises promises() { return {.affine = true, .largest_n = 3}; }
};

using namespace polyfem;
INSTANTIATE_TYPED_TEST_SUITE_P(LinearTriangle, BasisProperties, LinearTrianglePromises);

}  // namespace
