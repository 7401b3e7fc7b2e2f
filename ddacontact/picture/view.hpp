/// \file From the scene to the page.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// A rectangle of the scene, m.
struct Window {
  Vec2 low{0, 0}, high{0, 0};
  double width() const { return high.x() - low.x(); }
  double height() const { return high.y() - low.y(); }
};

/// The smallest box that holds both.
Window united(const Window& a, const Window& b);

/// The outlines of a frame, and the undeformed ones too when `reference`.
Window bounding_box(const Frame& frame, bool reference);

/// A box and a margin about it, a fraction of its larger side; a metre about a point.
Window padded(const Window& box, double margin);

/// Draws `box` with its upper left corner at `corner`, `scale` pixels a metre.
struct View {
  Window box;
  Vec2 corner{0, 0};
  double scale = 1;

  Vec2 operator()(const Vec2& x) const {
    return corner + scale * Vec2(x.x() - box.low.x(), box.high.y() - x.y());
  }
  /// A vector of the scene, turned as the page is, in pixels.
  Vec2 direction(const Vec2& v) const { return scale * Vec2(v.x(), -v.y()); }
  Vec2 size() const { return scale * Vec2(box.width(), box.height()); }
};

/// The median of the square roots of the blocks' areas, m.
double typical_size(const Frame& frame);

}  // namespace ddacontact
