#include <ddacontact/contact/kinematics.hpp>

namespace ddacontact {

VertexEdgeForm gap_form(const VertexEdgePositions& start) {
  const auto& [i, j, k] = start;
  const double l = (k - j).norm();
  const double S0 = cross(j - i, k - i);  // (34), twice an area
  // (37): the derivative of S0 / l by the displacement of each point
  const Vec2 e_i = Vec2(j.y() - k.y(), k.x() - j.x()) / l;
  const Vec2 e_j = Vec2(k.y() - i.y(), i.x() - k.x()) / l;
  const Vec2 e_k = Vec2(i.y() - j.y(), j.x() - i.x()) / l;
  return {-S0 / l, {-e_i, -e_j, -e_k}};
}

VertexEdgeForm slip_form(const VertexEdgePositions& start, double lock) {
  const auto& [i, j, k] = start;
  const Vec2 t = (k - j).normalized();
  const Vec2 o = (1 - lock) * j + lock * k;
  // (45), with the signed weights of (43)
  return {t.dot(i - o), {t, -(1 - lock) * t, -lock * t}};  // (42) over l
}

double edge_fraction(const Vec2& i, const Vec2& j, const Vec2& k) {
  return (i - j).dot(k - j) / (k - j).squaredNorm();
}

}  // namespace ddacontact
