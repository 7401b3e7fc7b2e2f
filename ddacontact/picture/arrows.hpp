/// \file Vectors as arrows, principal stresses as crosses.
#pragma once

#include <ddacontact/picture/field.hpp>
#include <ddacontact/picture/view.hpp>

#include <vector>

namespace ddacontact {

/// What can be shown by arrows and lines.
enum class VectorKind { contact_forces, displacement, velocity, principal_stresses };

/// What the numbers of the vectors are, in SI units.
const char* unit_of(VectorKind kind);

/// An arrow from a point of the scene, or a line through it when it has two ends.
struct Arrow {
  Vec2 from{0, 0};
  Vec2 vector{0, 0};
  enum class Look { plain, slipping, tension, compression } look = Look::plain;
};

/// Contact forces from the contact's place, all of a joint on the same block, whichever has the vertex: on
/// the one that has moved where the other has not; else on the upper one, into which the normals point up;
/// across a vertical joint on the smaller one, and of two as large as each other on the right one.
/// Displacement and velocity of the middle of each block from there; principal mean stresses as lines through
/// it.
std::vector<Arrow> arrows_of(const Frame& frame, VectorKind kind);

/// Whether the frame holds what the vectors are computed from.
bool holds(const Frame& frame, VectorKind kind);

/// The largest length of a vector.
double largest(const std::vector<Arrow>& arrows);

/// Arrows shorter than a pixel are left out.
void draw_arrows(SvgPage& page, const View& view, const std::vector<Arrow>& arrows, VectorKind kind,
                 double pixels_per_unit);

/// An arrow or line of `pixels` to the right from a place on the page, as the ones above look.
void draw_sample(SvgPage& page, const Vec2& from, double pixels, VectorKind kind, Arrow::Look look);

}  // namespace ddacontact
