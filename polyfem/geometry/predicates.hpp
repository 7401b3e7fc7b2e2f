/// \file Exact geometric decisions: the sign is right for every input of moderate exponent.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Sign of cross(b - a, c - a): +1 when c lies left of the line from a to b, -1 right of it, 0 exactly on it.
/// A floating-point filter decides nearly always; otherwise the determinant is summed without round-off.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether p lies on the closed segment ab. Exact.
bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p);

/// Whether the closed segments ab and cd have a point in common. Exact.
bool segments_intersect(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace polyfem
