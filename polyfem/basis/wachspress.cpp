#include <polyfem/basis/edge_area.hpp>
#include <polyfem/basis/packets.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

namespace polyfem {
namespace {

/// Vertex i and edge i of the polygon, the same in all lanes.
template <class Edge>
struct Corner {
  Corner(const Vec2& from, const Vec2& to)
      : edge(from, to), tiny(in_all_lanes(1e-100 * (to - from).squaredNorm())) {}

  Edge edge;
  Lanes tiny;              ///< an area that makes no difference but where there is none
  Lanes b;                 ///< b_i
  bool nearly_parallel;    ///< whether edges i-1 and i+1 differ by less than 0.1 in direction
  Lanes c;                 ///< then the cross product of these edges
  LaneVector base, shift;  ///< and base + shift / c is where their lines meet
};

/// What the points of a packet have at vertex i and edge i.
struct Term {
  Lanes N;          ///< w_i, then N_i
  LaneVector step;  ///< r_i+1 - r_i, turned right
  LaneVector left;  ///< sum_{j < i} N_j (r_i - r_j), turned right
};

/// Where the packet's results go, vertex by vertex `stride` numbers apart.
struct Destination {
  double *values, *dx, *dy;
  Index stride;

  /// What `tiny` has left of a function where it vanishes becomes an exact zero.
  void set_value(std::size_t i, const Lanes& N) const {
    store((N + 1e-40) - 1e-40, values + static_cast<Index>(i) * stride);
  }
  void set_gradient(std::size_t i, const LaneVector& turned_right) const {
    store(-turned_right.y, dx + static_cast<Index>(i) * stride);
    store(turned_right.x, dy + static_cast<Index>(i) * stride);
  }
};

/// The point is measured from the end of the edge that turns more, as it is nearer to it.
template <class Edge>
void set_meeting_point(const Edge& before, const Edge& edge, const Edge& after, Corner<Edge>& corner) {
  corner.c = cross(before, after);
  const LaneVector &in = before.direction(), &out = after.direction();
  corner.nearly_parallel = corner.c[0] > 0 && corner.c[0] < 0.1 * dot(in, out)[0];
  if (!corner.nearly_parallel) return;
  const Lanes turn = cross(before, edge), turn_after = cross(edge, after);
  const bool more_at_start =
      turn[0] * turn[0] * dot(out, out)[0] > turn_after[0] * turn_after[0] * dot(in, in)[0];
  corner.base = more_at_start ? edge.from() : after.from();
  corner.shift = more_at_start ? turn_after * in : LaneVector{} - turn * out;
}

template <class Edge>
const std::vector<Corner<Edge>>& corners_of(const PointsRef& polygon) {
  thread_local std::vector<Corner<Edge>> corners;
  corners.clear();
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i) corners.emplace_back(polygon.col(i), polygon.col(i + 1 == n ? 0 : i + 1));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Edge &before = corners[i == 0 ? corners.size() - 1 : i - 1].edge, &edge = corners[i].edge,
               &after = corners[i + 1 == corners.size() ? 0 : i + 1].edge;
    corners[i].b = cross(before, edge);
    if constexpr (Edge::any_shape) set_meeting_point(before, edge, after, corners[i]);
  }
  return corners;
}

/// What the points of a packet have at an edge.
struct EdgeTerm {
  Lanes inverse_area;  ///< 1 / a_i
  LaneVector log;      ///< grad log a_i = grad a_i / a_i turned right, which is the edge / a_i

  template <class Edge>
  EdgeTerm(const Corner<Edge>& corner, const LaneVector& x)
      : inverse_area(1 / (corner.edge.area(x) + corner.tiny)), log(inverse_area * corner.edge.direction()) {}
};

/// r_i+1 - r_i = grad log (a_i-1 / a_i+1), turned right.
template <class Edge>
LaneVector step_over_edge(const Corner<Edge>& corner, const LaneVector& x, const EdgeTerm& before,
                          const EdgeTerm& after) {
  if constexpr (Edge::any_shape)
    if (corner.nearly_parallel)
      return (before.inverse_area * after.inverse_area) * (corner.c * (corner.base - x) + corner.shift);
  return before.log - after.log;
}

/// Where the results of points q and following go.
Destination rows_from(Index q, ShapeTable& table) {
  return {&table.values(q, 0), &table.dx(q, 0), &table.dy(q, 0), table.n_points()};
}

/// See the header for the formulas.
template <class Edge>
void evaluate_packet(std::span<const Corner<Edge>> corners, const LaneVector& x, std::span<Term> terms,
                     Destination out) {
  const std::size_t last = corners.size() - 1;
  const EdgeTerm last_edge(corners[last], x), first_edge(corners[0], x);
  EdgeTerm before = last_edge, edge = first_edge;
  Lanes sum = terms[0].N = corners[0].b * (before.inverse_area * edge.inverse_area);
  for (std::size_t i = 1; i <= last; ++i) {
    const EdgeTerm after = i == last ? last_edge : EdgeTerm(corners[i], x);
    terms[i - 1].step = step_over_edge(corners[i - 1], x, before, after);
    terms[i].N = corners[i].b * (edge.inverse_area * after.inverse_area);
    sum += terms[i].N;
    before = edge;
    edge = after;
  }
  terms[last].step = step_over_edge(corners[last], x, before, first_edge);

  const Lanes inverse_sum = 1 / sum;
  Lanes front{};  // sum of N_j, j < i
  LaneVector left{};
  for (std::size_t i = 0; i <= last; ++i) {
    const Lanes N = terms[i].N * inverse_sum;
    const LaneVector step = terms[i].step;
    terms[i].N = N;
    terms[i].left = left;
    out.set_value(i, N);
    front += N;
    left += front * step;
  }

  const Lanes N_first = terms[0].N, N_last = terms[last].N;
  Lanes back = N_last;  // sum of N_j, j > i
  LaneVector right{}, inner_sum{};
  for (std::size_t i = last - 1; i > 0; --i) {
    const Lanes N = terms[i].N;
    right -= back * terms[i].step;
    const LaneVector gradient = N * (terms[i].left + right);
    inner_sum += gradient;
    back += N;
    out.set_gradient(i, gradient);
  }
  right -= back * terms[0].step;

  // Near the last edge the gradients of its two ends share a large 1 / a, which must not be added to be
  // subtracted again: then they are found from their sum and from the difference of their logarithms.
  const auto near_last_edge = N_first + N_last > 0.5;
  const Lanes part = N_first / (N_first + N_last);
  const LaneVector exchanged = (part * N_last) * terms[last].step;
  out.set_gradient(0, select(near_last_edge, exchanged - part * inner_sum, N_first * right));
  out.set_gradient(last,
                   select(near_last_edge, (part - 1) * inner_sum - exchanged, N_last * terms[last].left));
}

void evaluate_any_shape(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) {
  const std::span<const Corner<PreciseEdge>> corners = corners_of<PreciseEdge>(polygon);
  thread_local std::vector<Term> terms;
  terms.resize(corners.size());
  for_each_packet(points, table, [&](const LaneVector& x, Index row, ShapeTable& to) {
    evaluate_packet<PreciseEdge>(corners, x, terms, rows_from(row, to));
  });
}

/// Of the size of a polygon: the distance from an edge that is far. Gradients err by a few eps over it.
constexpr double far = 1. / 32;

/// Corner i and edge i of a well-shaped polygon. Edges and b_i are scaled to a size of about 1, which cancels
/// in all that is made of them.
struct PlainCorner {
  Same from_x, from_y, edge_x, edge_y;
  Same b;           ///< b_i
  Same least_area;  ///< a_i of points that are far enough from edge i

  Lanes area(const LaneVector& x) const { return (from_x - x.x) * edge_y - (from_y - x.y) * edge_x; }
};

/// What the points of a packet have at vertex i.
struct PlainTerm {
  Lanes w;
  LaneVector log;  ///< -r_i, turned right
};

/// N and grad N = N (r_i - sum_j N_j r_j) of points that are far from all edges: nothing large cancels there,
/// and it takes half of the operations. Returns the lanes with such points.
LaneMask evaluate_far_from_edges(std::span<const PlainCorner> corners, const LaneVector& x,
                                 std::span<PlainTerm> terms, const Destination& out) {
  struct Edge {
    Lanes inverse_area;
    LaneVector log;
  };
  LaneMask is_far = Lanes{} == Lanes{};
  const auto edge_of = [&](const PlainCorner& corner) {
    const Lanes area = corner.area(x), inverse = 1 / area;
    is_far &= area > corner.least_area;
    return Edge{inverse, {inverse * corner.edge_x, inverse * corner.edge_y}};
  };
  Edge before = edge_of(corners.back());
  const Edge last = before;
  Lanes sum{};
  LaneVector mean{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Edge edge = i + 1 == corners.size() ? last : edge_of(corners[i]);
    PlainTerm& term = terms[i];
    term.w = (before.inverse_area * edge.inverse_area) * corners[i].b;
    term.log = before.log + edge.log;
    sum += term.w;
    mean += term.w * term.log;
    before = edge;
  }
  const Lanes inverse_sum = 1 / sum;
  mean = inverse_sum * mean;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Lanes N = terms[i].w * inverse_sum;
    const Index at = static_cast<Index>(i) * out.stride;
    store(N, out.values + at);
    store(N * (terms[i].log.y - mean.y), out.dx + at);
    store(N * (mean.x - terms[i].log.x), out.dy + at);
  }
  return is_far;
}

/// The products of two areas, over those of the corners: on quadrilaterals nothing large cancels at any
/// point.
void evaluate_quadrilateral(std::span<const PlainCorner, 4> corners, const LaneVector& x,
                            const Destination& out) {
  Lanes a[4], w[4], dx[4], dy[4];
  for (int k = 0; k < 4; ++k) a[k] = corners[k].area(x);
  Lanes sum{}, sum_dx{}, sum_dy{};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4, k = (i + 2) % 4;
    const Lanes with_j = a[k] * corners[i].b, with_k = a[j] * corners[i].b;
    w[i] = a[j] * with_j;
    dx[i] = with_j * corners[j].edge_y + with_k * corners[k].edge_y;  // of -w
    dy[i] = with_j * corners[j].edge_x + with_k * corners[k].edge_x;
    sum += w[i];
    sum_dx += dx[i];
    sum_dy += dy[i];
  }
  const Lanes inverse_sum = 1 / sum;
  for (int i = 0; i < 4; ++i) {
    const Lanes N = w[i] * inverse_sum;
    store(N, out.values + i * out.stride);
    store((N * sum_dx - dx[i]) * inverse_sum, out.dx + i * out.stride);
    store((dy[i] - N * sum_dy) * inverse_sum, out.dy + i * out.stride);
  }
}

/// Corners of a polygon whose every b_i, over the square of the longer edge, is at least 0.05: then plain
/// areas give the shape functions to 5e-15, and to about 2e-16 over the least such ratio otherwise. Empty for
/// other polygons.
std::span<const PlainCorner> plain_corners_of(const PointsRef& polygon) {
  thread_local std::vector<PlainCorner> corners;
  const Index n = polygon.cols();
  corners.resize(static_cast<std::size_t>(n));
  Vec2 in = polygon.col(0) - polygon.col(n - 1);
  double in_square = in.squaredNorm();
  const double scale = std::ldexp(1., -std::ilogb(in_square));  // rounds nothing
  const double far_from =
      n == 4 ? 0 : far * scale * (polygon.rowwise().maxCoeff() - polygon.rowwise().minCoeff()).maxCoeff();
  for (Index i = 0; i < n; ++i) {
    const Vec2 from = polygon.col(i), out = polygon.col(i + 1 == n ? 0 : i + 1) - from;
    const double out_square = out.squaredNorm(), b = cross(in, out);
    if (!(b >= 0.05 * std::max(in_square, out_square))) return {};
    corners[static_cast<std::size_t>(i)] = {
        same(from.x()),        same(from.y()),  same(scale * out.x()),
        same(scale * out.y()), same(scale * b), same(n == 4 ? 0 : far_from * std::sqrt(out_square))};
    in = out;
    in_square = out_square;
  }
  return corners;
}

/// Points near an edge among those of a packet get what the formulas of the header give.
void evaluate_well_shaped(const PointsRef& polygon, std::span<const PlainCorner> corners,
                          const PointsRef& points, ShapeTable& table) {
  thread_local std::vector<PlainTerm> plain_terms;
  thread_local std::vector<Term> terms;
  thread_local ShapeTable near;
  plain_terms.resize(corners.size());
  std::span<const Corner<PlainEdge>> all_corners;
  for_each_packet(points, table, [&](const LaneVector& x, Index row, ShapeTable& to) {
    if (corners.size() == 4) {
      evaluate_quadrilateral(corners.first<4>(), x, rows_from(row, to));
      return;
    }
    const LaneMask is_far = evaluate_far_from_edges(corners, x, plain_terms, rows_from(row, to));
    if (holds_for_all(is_far)) return;
    if (all_corners.empty()) all_corners = corners_of<PlainEdge>(polygon);
    terms.resize(corners.size());
    resize(near, n_lanes, polygon.cols());
    evaluate_packet<PlainEdge>(all_corners, x, terms, rows_from(0, near));
    take_other_rows(is_far, near, row, to);
  });
}

}  // namespace

std::optional<Rejection> Wachspress::find_rejection(const PointsRef& polygon) const {
  if (const std::optional<int> corner = find_non_convex_corner(polygon))
    return Rejection{*corner, "does not turn left, which Wachspress functions need: use mean_value"};
  return std::nullopt;
}

void Wachspress::evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const {
  assert(polygon.cols() >= 3);
  resize(table, points.cols(), polygon.cols());
  if (const std::span<const PlainCorner> corners = plain_corners_of(polygon);
      !corners.empty()) {  // so convex
    evaluate_well_shaped(polygon, corners, points, table);
  } else {
    require_suitable(*this, polygon);
    evaluate_any_shape(polygon, points, table);
  }
}

}  // namespace polyfem
