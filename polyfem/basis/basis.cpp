#include <polyfem/basis/basis.hpp>
#include <polyfem/core/error.hpp>

namespace polyfem {

void Basis::operator()(const PointsRef& polygon, const Vec2& x, ShapeValues& shape) const {
  thread_local ShapeTable table;
  evaluate(polygon, x, table);
  shape.values = table.values.row(0).transpose();
  shape.gradients.resize(2, polygon.cols());
  shape.gradients.row(0) = table.dx.row(0);
  shape.gradients.row(1) = table.dy.row(0);
}

void require_suitable(const Basis& basis, const PointsRef& polygon) {
  if (const std::optional<Rejection> rejection = basis.find_rejection(polygon))
    throw Error(std::string(basis.name()) + ": vertex " + std::to_string(rejection->vertex) + " " +
                rejection->reason);
}

}  // namespace polyfem
