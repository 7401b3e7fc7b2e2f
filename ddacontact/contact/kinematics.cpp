#include <ddacontact/contact/kinematics.hpp>

#include <ddacontact/contact/edge_motion.hpp>

namespace ddacontact {

AffineForm gap_form(const MovingPoint& i, const MovingPoint& j, const MovingPoint& k) {
  const double l = (k.x - j.x).norm();
  const double S0 = cross(j.x - i.x, k.x - i.x);  // (34), twice an area
  // (37): the derivative of S0 / l by the displacement of each point
  const Vec2 e_i = Vec2(j.x.y() - k.x.y(), k.x.x() - j.x.x()) / l;
  const Vec2 e_j = Vec2(k.x.y() - i.x.y(), i.x.x() - k.x.x()) / l;
  const Vec2 e_k = Vec2(i.x.y() - j.x.y(), j.x.x() - i.x.x()) / l;
  AffineForm gap = gradient_form({-e_i, -e_j, -e_k}, i.map, j.map, k.map);
  gap.constant = -S0 / l;
  return gap;
}

AffineForm slip_form(const MovingPoint& i, const MovingPoint& j, const MovingPoint& k, double lock) {
  const Vec2 t = (k.x - j.x).normalized();
  const Vec2 o = (1 - lock) * j.x + lock * k.x;
  // (45), with the signed weights of (43)
  AffineForm slip = gradient_form({t, -(1 - lock) * t, -lock * t}, i.map, j.map, k.map);
  slip.constant = t.dot(i.x - o);  // (42) over l
  return slip;
}

double edge_fraction(const Vec2& i, const Vec2& j, const Vec2& k) {
  return (i - j).dot(k - j) / (k - j).squaredNorm();
}

}  // namespace ddacontact
