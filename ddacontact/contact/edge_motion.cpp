#include <ddacontact/contact/edge_motion.hpp>

#include <cassert>
#include <utility>

namespace ddacontact {

namespace {

Vec2 turned_clockwise(const Vec2& x) {
  return {x.y(), -x.x()};
}

struct Edge {
  explicit Edge(const VertexEdgePositions& positions)
      : a(positions.k - positions.j), b(positions.i - positions.j), l(a.norm()) {
    assert(l > 0);
  }
  Vec2 t() const { return a / l; }
  Vec2 n() const { return turned_clockwise(a) / l; }
  double along_t() const { return a.dot(b) / l; }
  double along_n() const { return cross(b, a) / l; }

  Vec2 a, b;
  double l;
};

/// What the motion changes: b by `b`, l by `l`, t by `t`. Each is no sum of anything larger than itself.
struct EdgeChange {
  EdgeChange(const Edge& start, const VertexEdgePositions& by)
      : b(by.i - by.j),
        l((2 * start.a + by.k - by.j).dot(by.k - by.j) / (start.l + (start.a + by.k - by.j).norm())),
        t((by.k - by.j - l * start.t()) / (start.l + l)) {}

  Vec2 b;
  double l;
  Vec2 t;
};

/// b = i - j and a = k - j
VertexEdgeGradient by_points(const Vec2& by_b, const Vec2& by_a) {
  return {by_b, -by_b - by_a, by_a};
}

/// What discrete gradients are made of. Those of the quadratic l^2, a . b and l n . b are their gradients at
/// the mean, which have no moment there: rotations change none of the three. The rest follows by
///     l1 - l0 = (l1^2 - l0^2) / (l0 + l1),
///     X1 / l1 - X0 / l0 = mean(1 / l) (X1 - X0) - mean(X) (l1 - l0) / (l0 l1).
struct MeanEdge {
  MeanEdge(const Edge& start, const Edge& end)
      : a((start.a + end.a) / 2),
        b((start.b + end.b) / 2),
        length_by_a(2 * a / (start.l + end.l)),
        inverse_length((1 / start.l + 1 / end.l) / 2) {}

  Vec2 a, b;
  Vec2 length_by_a;
  double inverse_length;
};

double gap_change(const Edge& start, const EdgeChange& by) {
  return turned_clockwise(start.t() + by.t).dot(by.b) + turned_clockwise(by.t).dot(start.b);
}
double slip_of(const Edge& edge, double lock) {
  return edge.along_t() - lock * edge.l;
}
double slip_change(const Edge& start, const EdgeChange& by, double lock) {
  return (start.t() + by.t).dot(by.b) + by.t.dot(start.b) - lock * by.l;
}

VertexEdgeGradient gap_gradient(const Edge& edge) {
  return by_points(edge.n(), -edge.along_t() / edge.l * edge.n());
}
VertexEdgeGradient slip_gradient(const Edge& edge, double lock) {
  return by_points(edge.t(), edge.along_n() / edge.l * edge.n() - lock * edge.t());
}

VertexEdgeGradient gap_mean_gradient(const Edge& start, const Edge& end) {
  const MeanEdge mean(start, end);
  const double by_length = -(start.along_n() / end.l + end.along_n() / start.l) / 2;
  return by_points(mean.inverse_length * turned_clockwise(mean.a),
                   by_length * mean.length_by_a - mean.inverse_length * turned_clockwise(mean.b));
}
VertexEdgeGradient slip_mean_gradient(const Edge& start, const Edge& end, double lock) {
  const MeanEdge mean(start, end);
  const double by_length = -(start.along_t() / end.l + end.along_t() / start.l) / 2 - lock;
  return by_points(mean.inverse_length * mean.a, by_length * mean.length_by_a + mean.inverse_length * mean.b);
}

/// Whether each of the three points has unknowns of its own.
bool are_all_own(const PointMap& i, const PointMap& j, const PointMap& k) {
  const int a = i.first_unknown(), b = j.first_unknown(), c = k.first_unknown();
  return i.is_own() && j.is_own() && k.is_own() && a != b && b != c && c != a;
}

}  // namespace

double gap(const VertexEdgePositions& positions) {
  return Edge(positions).along_n();
}

GapAndSlip gap_and_slip(const VertexEdgePositions& start, const VertexEdgePositions& by, double lock,
                        Directions directions) {
  const Edge edge0(start), edge1({start.i + by.i, start.j + by.j, start.k + by.k});
  const EdgeChange change(edge0, by);
  const Edge& at = directions == Directions::of_start ? edge0 : edge1;
  const bool mean = directions == Directions::mean;
  return {edge0.along_n() + gap_change(edge0, change),
          slip_of(edge0, lock) + slip_change(edge0, change, lock),
          mean ? gap_mean_gradient(edge0, edge1) : gap_gradient(at),
          mean ? slip_mean_gradient(edge0, edge1, lock) : slip_gradient(at, lock)};
}

AffineForm gradient_form(const VertexEdgeGradient& gradient, const PointMap& i, const PointMap& j,
                         const PointMap& k) {
  AffineForm form;
  if (are_all_own(i, j, k)) {
    const int a = i.first_unknown(), b = j.first_unknown(), c = k.first_unknown();
    for (const auto& [first, by] : {std::pair(a, &gradient.i), {b, &gradient.j}, {c, &gradient.k}}) {
      form.append(first, by->x());
      form.append(first + 1, by->y());
    }
    return form;
  }
  i.add_to(form, gradient.i);
  j.add_to(form, gradient.j);
  k.add_to(form, gradient.k);
  return form;
}

double change_along(const VertexEdgeGradient& gradient, const PointMap& i, const PointMap& j,
                    const PointMap& k, const VectorXd& d) {
  if (!are_all_own(i, j, k)) return gradient_form(gradient, i, j, k).change(d);
  double sum = 0;
  for (const auto& [point, by] : {std::pair(&i, &gradient.i), {&j, &gradient.j}, {&k, &gradient.k}}) {
    sum += by->x() * d[point->first_unknown()];
    sum += by->y() * d[point->first_unknown() + 1];
  }
  return sum;
}

}  // namespace ddacontact
