#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace polyfem {
namespace {

constexpr int exponent_step = 300;
constexpr int exponent_of_zero = -1000000;  // below that of any product of numbers other than zero
constexpr double tiny = 0x1p-300, huge = 0x1p300;

/// A product of areas and its gradient, both times 2^(exponent_step * exponent).
struct Product {
  double value = 1;
  Vec2 gradient = Vec2::Zero();
  int exponent = 0;
};

/// Areas are at most of order one and their sum is bounded, so products of them can only underflow.
Product operator*(const Product& f, const Product& g) {
  Product h{f.value * g.value, f.value * g.gradient + g.value * f.gradient, f.exponent + g.exponent};
  const double magnitude =
      std::max(std::abs(h.value), std::max(std::abs(h.gradient.x()), std::abs(h.gradient.y())));
  if (magnitude == 0) {
    h.exponent = exponent_of_zero;
  } else if (magnitude < tiny) {
    h.value *= huge;
    h.gradient *= huge;
    --h.exponent;
  }
  return h;
}

/// The power of two that brings the polygon, seen from x, into the square of half width one.
double unit_scale(const PointsRef& polygon, const Vec2& x) {
  int exponent = 0;
  std::frexp((polygon.colwise() - x).cwiseAbs().maxCoeff(), &exponent);
  return std::ldexp(1., -exponent);
}

/// a_k and its gradient, the edge turned left: a_k = cross(v_k - x, v_k+1 - x) in units of 1/scale.
void edge_areas(const PointsRef& polygon, const Vec2& x, double scale, std::vector<Product>& area) {
  const Index n = polygon.cols();
  Vec2 before = polygon.col(n - 1), to_before = scale * (before - x);
  for (Index i = 0; i < n; ++i) {
    const Vec2 vertex = polygon.col(i), to_vertex = scale * (vertex - x), edge = scale * (vertex - before);
    area[static_cast<std::size_t>(i == 0 ? n - 1 : i - 1)] = {cross(to_before, to_vertex),
                                                              Vec2(-edge.y(), edge.x()), 0};
    before = vertex;
    to_before = to_vertex;
  }
}

/// product[i] = prod_{k != i-1, i} a_k = (a_0 .. a_i-2)(a_i+1 .. a_n-1), and a_1 .. a_n-2 for i = 0.
void products_without_own_edges(const std::vector<Product>& area, std::vector<Product>& product) {
  const std::size_t n = area.size();
  product[0] = product[1] = Product{};
  for (std::size_t i = 2; i < n; ++i) {
    product[i] = product[i - 1] * area[i - 2];
    product[0] = product[0] * area[i - 1];
  }
  Product behind;
  for (std::size_t i = n - 1; i > 1; --i) {
    product[i] = product[i] * behind;
    behind = behind * area[i];
  }
  product[1] = behind;
}

void evaluate_at(const PointsRef& polygon, const Vec2& x, Index q, ShapeTable& table) {
  const std::size_t n = static_cast<std::size_t>(polygon.cols());
  thread_local std::vector<Product> area, product;
  area.resize(n);
  product.resize(n);

  const double scale = unit_scale(polygon, x);
  edge_areas(polygon, x, scale, area);
  products_without_own_edges(area, product);

  int exponent = exponent_of_zero;  // the one all weights are brought to
  for (const Product& p : product) exponent = std::max(exponent, p.exponent);
  double sum = 0;
  Vec2 sum_gradient = Vec2::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    double b =
        cross(area[i == 0 ? n - 1 : i - 1].gradient, area[i].gradient);  // turned edges: the same cross
    if (product[i].exponent != exponent) b = std::ldexp(b, exponent_step * (product[i].exponent - exponent));
    product[i].value *= b;
    product[i].gradient *= b;
    sum += product[i].value;
    sum_gradient += product[i].gradient;
  }
  // N_i = w_i / W, grad N_i = (grad w_i - N_i grad W) / W
  for (std::size_t i = 0; i < n; ++i) {
    const Index vertex = static_cast<Index>(i);
    const double N = product[i].value / sum;
    table.values(q, vertex) = N;
    table.dx(q, vertex) = (product[i].gradient.x() - N * sum_gradient.x()) * (scale / sum);
    table.dy(q, vertex) = (product[i].gradient.y() - N * sum_gradient.y()) * (scale / sum);
  }
}

}  // namespace

std::optional<Objection> Wachspress::find_objection(const PointsRef& polygon) const {
  if (const std::optional<int> corner = find_non_convex_corner(polygon))
    return Objection{*corner, "does not turn left, which Wachspress functions need: use mean_value"};
  return std::nullopt;
}

void Wachspress::evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const {
  assert(polygon.cols() >= 3);
  table.values.resize(points.cols(), polygon.cols());
  table.dx.resize(points.cols(), polygon.cols());
  table.dy.resize(points.cols(), polygon.cols());
  for (Index q = 0; q < points.cols(); ++q) evaluate_at(polygon, points.col(q), q, table);
}

}  // namespace polyfem
