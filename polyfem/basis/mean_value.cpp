#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/mean_value_at_vertex.hpp>

#include <cassert>
#include <limits>
#include <utility>
#include <vector>

namespace polyfem {
namespace {

/// One number for each of the points that are evaluated together.
template <int n_lanes>
using Lanes = Eigen::Array<double, n_lanes, 1>;

/// A vector for each of them.
template <int n_lanes>
struct LaneVectors {
  Lanes<n_lanes> x, y;
};

/// Vertex i and its weight, seen from the points; the edge to vertex i + 1 and its angle's half tangent.
template <int n_lanes>
struct Terms {
  LaneVectors<n_lanes> d, u;    // v_i - x and its direction
  Lanes<n_lanes> rho, inverse;  // |d| and 1/|d|
  Lanes<n_lanes> weight;        // c_k w_i
  LaneVectors<n_lanes> weight_gradient;

  Vec2 c_gradient;           // the edge turned left
  Lanes<n_lanes> c, dot, t;  // t: times c_k after `clear_largest`
  LaneVectors<n_lanes> t_gradient;
};

/// For each point the index and the size of what is extreme there. Indices are doubles as everything in
/// lanes.
template <int n_lanes>
struct Extreme {
  Lanes<n_lanes> size, index = Lanes<n_lanes>::Zero();

  void include(const Lanes<n_lanes>& candidate, std::size_t i) {
    for (int lane = 0; lane < n_lanes; ++lane) {
      const bool larger = candidate[lane] > size[lane];
      index[lane] = larger ? static_cast<double>(i) : index[lane];
      size[lane] = larger ? candidate[lane] : size[lane];
    }
  }
  std::size_t operator[](int lane) const { return static_cast<std::size_t>(index[lane]); }
};

/// All functions at n_lanes points.
template <int n_lanes>
class MeanValueAtPoints {
 public:
  void evaluate(const PointsRef& polygon, const PointsRef& points, Index first, ShapeTable& table) {
    terms_.resize(static_cast<std::size_t>(polygon.cols()));
    see_vertices(polygon, points.middleCols(first, n_lanes));
    see_edges(polygon);
    clear_largest();
    find_weights();
    write(first, table);
    for (int lane = 0; lane < n_lanes; ++lane)
      if (-nearest_.size[lane] < smallest_distance)
        mean_value_at_vertex(polygon, static_cast<Index>(nearest_[lane]), first + lane, table);
  }

 private:
  static constexpr double smallest_distance = 1e-140;  // squares of smaller lengths lose digits to underflow
  using Values = Lanes<n_lanes>;
  using Term = Terms<n_lanes>;

  std::size_t after(std::size_t i) const { return i + 1 == terms_.size() ? 0 : i + 1; }

  void see_vertices(const PointsRef& polygon, const PointsRef& points) {
    const Values x = points.row(0).transpose(), y = points.row(1).transpose();
    nearest_.size.setConstant(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Index vertex = static_cast<Index>(i);
      Term& term = terms_[i];
      term.d.x = polygon(0, vertex) - x;
      term.d.y = polygon(1, vertex) - y;
      term.rho = (term.d.x.square() + term.d.y.square()).sqrt();
      term.inverse = term.rho.inverse();
      term.u.x = term.d.x * term.inverse;
      term.u.y = term.d.y * term.inverse;
      nearest_.include(-term.rho, i);
    }
  }

  /// t = c / (rho rho' + d.d') where d.d' >= 0 and (rho rho' - d.d') / c elsewhere, so that nothing cancels.
  /// The gradient of rho rho' +- d.d' is -+ (u +- u')(rho +- rho').
  void see_edges(const PointsRef& polygon) {
    steepest_.size.setConstant(-1);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const std::size_t next = after(i);
      Term& a = terms_[i];
      const Term& b = terms_[next];
      const Vec2 edge = polygon.col(static_cast<Index>(next)) - polygon.col(static_cast<Index>(i));
      a.c_gradient = Vec2(-edge.y(), edge.x());
      a.dot = a.d.x * b.d.x + a.d.y * b.d.y;
      Values obtuse, from_b;  // 0 or 1
      for (int lane = 0; lane < n_lanes; ++lane) {
        obtuse[lane] = a.dot[lane] < 0 ? 1. : 0.;
        from_b[lane] = b.rho[lane] < a.rho[lane] ? 1. : 0.;
      }
      const Values sharp = 1 - obtuse, from_a = 1 - from_b, sign = sharp - obtuse;
      // from the nearer end, whose d has the smaller error
      a.c = (from_a * a.d.x + from_b * b.d.x) * edge.y() - (from_a * a.d.y + from_b * b.d.y) * edge.x();
      const Values sum = a.rho * b.rho + a.dot.abs();
      const Values inverse = (sharp * sum + obtuse * a.c).inverse();
      a.t = (sharp * a.c + obtuse * sum) * inverse;
      const Values of_c = (sharp - obtuse * a.t) * inverse;
      const Values of_u = (a.rho + sign * b.rho) * (obtuse + sharp * a.t) * inverse;
      a.t_gradient.x = of_c * a.c_gradient.x() + of_u * (a.u.x + sign * b.u.x);
      a.t_gradient.y = of_c * a.c_gradient.y() + of_u * (a.u.y + sign * b.u.y);
      steepest_.include(a.t.abs(), i);
    }
  }

  /// Multiplies all t by c_k of the edge k that has the largest at each point.
  void clear_largest() {
    Values c, c_x, c_y;
    for (int lane = 0; lane < n_lanes; ++lane) {
      const Term& term = terms_[steepest_[lane]];
      c[lane] = term.c[lane];
      c_x[lane] = term.c_gradient.x();
      c_y[lane] = term.c_gradient.y();
    }
    for (Term& term : terms_) {
      term.t_gradient.x = c * term.t_gradient.x + c_x * term.t;
      term.t_gradient.y = c * term.t_gradient.y + c_y * term.t;
      term.t *= c;
    }
    for (int lane = 0; lane < n_lanes; ++lane) {
      Term& a = terms_[steepest_[lane]];
      const Term& b = terms_[after(steepest_[lane])];
      if (a.dot[lane] >= 0) continue;  // t <= 1
      a.t[lane] = a.rho[lane] * b.rho[lane] - a.dot[lane];
      a.t_gradient.x[lane] = (a.u.x[lane] - b.u.x[lane]) * (a.rho[lane] - b.rho[lane]);
      a.t_gradient.y[lane] = (a.u.y[lane] - b.u.y[lane]) * (a.rho[lane] - b.rho[lane]);
    }
  }

  void find_weights() {
    const Term* before = &terms_.back();
    for (Term& at : terms_) {
      at.weight = (before->t + at.t) * at.inverse;
      at.weight_gradient.x = (before->t_gradient.x + at.t_gradient.x + at.weight * at.u.x) * at.inverse;
      at.weight_gradient.y = (before->t_gradient.y + at.t_gradient.y + at.weight * at.u.y) * at.inverse;
      before = &at;
    }
  }

  /// N_i = w_i / W and grad N_i = (grad w_i - N_i grad W) / W, for the nearest vertex j with 1 - N_j, which
  /// may be tiny, from the other weights: grad N_j = (grad w_j (1 - N_j) - N_j (grad W - grad w_j)) / W.
  void write(Index first, ShapeTable& table) {
    Values near, near_x, near_y;
    for (int lane = 0; lane < n_lanes; ++lane) {
      Term& term = terms_[nearest_[lane]];
      near[lane] = std::exchange(term.weight[lane], 0);
      near_x[lane] = std::exchange(term.weight_gradient.x[lane], 0);
      near_y[lane] = std::exchange(term.weight_gradient.y[lane], 0);
    }
    Values far = Values::Zero(), far_x = far, far_y = far;
    for (const Term& term : terms_) {
      far += term.weight;
      far_x += term.weight_gradient.x;
      far_y += term.weight_gradient.y;
    }
    const Values inverse = (near + far).inverse(), sum_x = near_x + far_x, sum_y = near_y + far_y;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Term& term = terms_[i];
      const Index column = static_cast<Index>(i);
      const Values N = term.weight * inverse;
      table.values.col(column).template segment<n_lanes>(first) = N;
      table.dx.col(column).template segment<n_lanes>(first) = (term.weight_gradient.x - N * sum_x) * inverse;
      table.dy.col(column).template segment<n_lanes>(first) = (term.weight_gradient.y - N * sum_y) * inverse;
    }
    const Values N = near * inverse, rest = far * inverse;
    const Values N_x = (near_x * rest - N * far_x) * inverse, N_y = (near_y * rest - N * far_y) * inverse;
    for (int lane = 0; lane < n_lanes; ++lane) {
      const Index column = static_cast<Index>(nearest_[lane]);
      table.values(first + lane, column) = N[lane];
      table.dx(first + lane, column) = N_x[lane];
      table.dy(first + lane, column) = N_y[lane];
    }
  }

  std::vector<Term> terms_;
  Extreme<n_lanes> nearest_, steepest_;
};

}  // namespace

std::optional<Objection> MeanValue::find_objection(const PointsRef& polygon) const {
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i)
    if (polygon.col(i) == polygon.col((i + 1) % n))
      return Objection{static_cast<int>(i), "is in the same place as the next: leave one of them out"};
  return std::nullopt;
}

void MeanValue::evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const {
  assert(polygon.cols() >= 3);
  for (MatrixXd* entries : {&table.values, &table.dx, &table.dy})
    entries->resize(points.cols(), polygon.cols());
  // The same operations on each point in either: a point's results do not depend on its neighbours.
  constexpr int n_lanes = 4;
  thread_local MeanValueAtPoints<n_lanes> at_points;
  thread_local MeanValueAtPoints<1> at_point;
  Index q = 0;
  for (; q + n_lanes <= points.cols(); q += n_lanes) at_points.evaluate(polygon, points, q, table);
  for (; q < points.cols(); ++q) at_point.evaluate(polygon, points, q, table);
}

}  // namespace polyfem
