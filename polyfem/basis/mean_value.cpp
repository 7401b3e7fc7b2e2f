#include <polyfem/basis/edge_area.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/mean_value_at_vertex.hpp>
#include <polyfem/basis/mean_value_far.hpp>
#include <polyfem/basis/packets.hpp>

#include <cassert>
#include <limits>
#include <span>
#include <vector>

namespace polyfem {
namespace {

using Edges = std::span<const PreciseEdge>;

/// Vertex i and its weight, seen from the points; the edge to vertex i + 1 and its angle's half tangent.
struct Term {
  LaneVector d, u;     ///< v_i - x and its direction
  Lanes rho, inverse;  ///< |d| and 1/|d|
  Lanes weight;        ///< c_k w_i
  LaneVector weight_gradient;

  Lanes c, dot, t;  ///< t: times c_k after `clear_largest`
  LaneVector t_gradient;
};

/// For each point the index and the size of what is largest there; where nothing compares, index 0. Indices
/// are doubles as everything in lanes.
struct Extreme {
  Lanes size = in_all_lanes(-std::numeric_limits<double>::infinity()), index{};

  void include(const Lanes& candidate, std::size_t i) {
    const auto larger = candidate > size;
    index = larger ? in_all_lanes(static_cast<double>(i)) : index;
    size = larger ? candidate : size;
  }
  std::size_t operator[](Index lane) const { return static_cast<std::size_t>(index[lane]); }
};

constexpr double smallest_distance = 1e-140;  // squares of smaller lengths lose digits to underflow

LaneVector turned_left(const LaneVector& v) {
  return {-v.y, v.x};
}

std::size_t after(std::size_t i, Edges edges) {
  return i + 1 == edges.size() ? 0 : i + 1;
}

/// Gives the nearest vertices.
Extreme see_vertices(Edges edges, const LaneVector& x, std::span<Term> terms) {
  Extreme nearest;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Term& term = terms[i];
    term.d = edges[i].from() - x;
    term.rho = sqrt(dot(term.d, term.d));
    term.inverse = 1 / term.rho;
    term.u = term.inverse * term.d;
    nearest.include(-term.rho, i);
  }
  return nearest;
}

/// t = c / (rho rho' + d.d') where d.d' >= 0 and (rho rho' - d.d') / c elsewhere, so that nothing cancels.
/// The gradient of rho rho' +- d.d' is -+ (u +- u')(rho +- rho'). Gives the edges with the largest |t|.
Extreme see_edges(Edges edges, const LaneVector& x, std::span<Term> terms) {
  Extreme steepest;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Term& a = terms[i];
    const Term& b = terms[after(i, edges)];
    a.c = edges[i].area(x);
    a.dot = dot(a.d, b.d);
    const auto obtuse = a.dot < 0;
    const Lanes one = in_all_lanes(1), sum = a.rho * b.rho + (obtuse ? -a.dot : a.dot);
    const Lanes inverse = 1 / (obtuse ? a.c : sum), sign = obtuse ? -one : one;
    a.t = (obtuse ? sum : a.c) * inverse;
    const Lanes of_c = (obtuse ? -a.t : one) * inverse;
    const Lanes of_u = (a.rho + sign * b.rho) * (obtuse ? one : a.t) * inverse;
    a.t_gradient = of_c * turned_left(edges[i].direction()) + of_u * (a.u + sign * b.u);
    steepest.include(a.t < 0 ? -a.t : a.t, i);
  }
  return steepest;
}

/// Multiplies all t by c_k of the edge k that has the largest at each point.
void clear_largest(Edges edges, const Extreme& steepest, std::span<Term> terms) {
  Lanes c;
  LaneVector edge;
  for (Index lane = 0; lane < n_lanes; ++lane) {
    const std::size_t k = steepest[lane];
    c[lane] = terms[k].c[lane];
    edge.x[lane] = edges[k].direction().x[lane];
    edge.y[lane] = edges[k].direction().y[lane];
  }
  for (Term& term : terms) {
    term.t_gradient = c * term.t_gradient + term.t * turned_left(edge);
    term.t *= c;
  }
  for (Index lane = 0; lane < n_lanes; ++lane) {
    Term& a = terms[steepest[lane]];
    const Term& b = terms[after(steepest[lane], edges)];
    if (a.dot[lane] >= 0) continue;  // t <= 1
    a.t[lane] = a.rho[lane] * b.rho[lane] - a.dot[lane];
    a.t_gradient.x[lane] = (a.u.x[lane] - b.u.x[lane]) * (a.rho[lane] - b.rho[lane]);
    a.t_gradient.y[lane] = (a.u.y[lane] - b.u.y[lane]) * (a.rho[lane] - b.rho[lane]);
  }
}

void find_weights(std::span<Term> terms) {
  const Term* before = &terms.back();
  for (Term& at : terms) {
    at.weight = (before->t + at.t) * at.inverse;
    at.weight_gradient = at.inverse * (before->t_gradient + at.t_gradient + at.weight * at.u);
    before = &at;
  }
}

/// The number in a lane, and 0 in its place.
double take(Lanes& numbers, Index lane) {
  const double number = numbers[lane];
  numbers[lane] = 0;
  return number;
}

/// N_i = w_i / W and grad N_i = (grad w_i - N_i grad W) / W, for the nearest vertex j with 1 - N_j, which may
/// be tiny, from the other weights: grad N_j = (grad w_j (1 - N_j) - N_j (grad W - grad w_j)) / W.
void write(const Extreme& nearest, std::span<Term> terms, ShapeTable& packet) {
  Lanes near;
  LaneVector near_gradient;
  for (Index lane = 0; lane < n_lanes; ++lane) {
    Term& term = terms[nearest[lane]];
    near[lane] = take(term.weight, lane);
    near_gradient.x[lane] = take(term.weight_gradient.x, lane);
    near_gradient.y[lane] = take(term.weight_gradient.y, lane);
  }
  Lanes far{};
  LaneVector far_gradient{};
  for (const Term& term : terms) {
    far += term.weight;
    far_gradient += term.weight_gradient;
  }
  const Lanes inverse = 1 / (near + far);
  const LaneVector sum = near_gradient + far_gradient;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Lanes N = terms[i].weight * inverse;
    const LaneVector gradient = inverse * (terms[i].weight_gradient - N * sum);
    const Index column = static_cast<Index>(i);
    store(N, &packet.values(0, column));
    store(gradient.x, &packet.dx(0, column));
    store(gradient.y, &packet.dy(0, column));
  }
  const Lanes N = near * inverse, rest = far * inverse;
  const LaneVector gradient = inverse * (rest * near_gradient - N * far_gradient);
  for (Index lane = 0; lane < n_lanes; ++lane) {
    const Index column = static_cast<Index>(nearest[lane]);
    packet.values(lane, column) = N[lane];
    packet.dx(lane, column) = gradient.x[lane];
    packet.dy(lane, column) = gradient.y[lane];
  }
}

Edges edges_of(const PointsRef& polygon) {
  thread_local std::vector<PreciseEdge> edges;
  edges.clear();
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i) edges.emplace_back(polygon.col(i), polygon.col(i + 1 == n ? 0 : i + 1));
  return edges;
}

/// The table of a packet, by formulas that are good at any point.
void evaluate_anywhere(const PointsRef& polygon, Edges edges, const LaneVector& x, ShapeTable& packet) {
  thread_local std::vector<Term> terms;
  terms.resize(edges.size());
  const Extreme nearest = see_vertices(edges, x, terms);
  clear_largest(edges, see_edges(edges, x, terms), terms);
  find_weights(terms);
  write(nearest, terms, packet);
  for (Index lane = 0; lane < n_lanes; ++lane)
    if (-nearest.size[lane] < smallest_distance)
      mean_value_at_vertex(polygon, static_cast<Index>(nearest[lane]), lane, packet);
}

}  // namespace

std::optional<Rejection> MeanValue::find_rejection(const PointsRef& polygon) const {
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i)
    if (polygon.col(i) == polygon.col((i + 1) % n))
      return Rejection{static_cast<int>(i), "is in the same place as the next: leave one of them out"};
  return std::nullopt;
}

void MeanValue::evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const {
  assert(polygon.cols() >= 3);
  resize(table, points.cols(), polygon.cols());
  thread_local MeanValueFarFromBoundary far_from_boundary;
  thread_local ShapeTable near;
  const bool may_be_far = far_from_boundary.set(polygon);
  std::span<const PreciseEdge> edges;
  for_each_packet(points, table, [&](const LaneVector& x, Index row, ShapeTable& to) {
    const LaneMask is_far = may_be_far ? far_from_boundary.evaluate(x, row, to) : LaneMask{};
    if (holds_for_all(is_far)) return;
    if (edges.empty()) edges = edges_of(polygon);
    resize(near, n_lanes, polygon.cols());
    evaluate_anywhere(polygon, edges, x, near);
    take_other_rows(is_far, near, row, to);
  });
}

}  // namespace polyfem
