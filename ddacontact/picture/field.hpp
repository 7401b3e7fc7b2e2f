/// \file What can be shown of a frame in colours.
#pragma once

#include <ddacontact/output/cell_view.hpp>
#include <ddacontact/picture/svg.hpp>

#include <optional>
#include <string_view>
#include <vector>

namespace ddacontact {

/// Numbers and kinds under the names of the result files' arrays. The fields of `block_fields()` follow in
/// their order.
enum class Field { none, sxx, syy, sxy, s1, s2, displacement, velocity, material, block, of_blocks };

/// Whether it is a component of the stress or a principal stress.
constexpr bool is_stress(Field field) {
  return field >= Field::sxx && field <= Field::s2;
}

/// How a field is drawn.
enum class FieldKind {
  outlines,   ///< nothing but outlines
  kinds,      ///< a plain colour per block
  magnitude,  ///< a number >= 0 at every point
  with_sign   ///< a number at every point, zero being special
};

/// What users read of a field.
struct FieldDescription {
  Field field;
  const char* name;  ///< as on a command line
  Label symbol;
  const char* unit;
  FieldKind kind;
};

/// All of them, in the order they are listed to users.
const std::vector<FieldDescription>& all_fields();
/// Of one field.
const FieldDescription& description(Field field);
/// The field of this name, or nothing.
std::optional<Field> field_named(std::string_view name);

/// Whether the frame holds what the field is computed from.
bool holds(const Frame& frame, Field field);

/// A field inside one cell of a block, on its present corners, by its shape functions.
///
/// Coordinates are relative to the first corner, so that they stay exact far from the origin.
class CellField {
 public:
  /// `field` is one of numbers (`magnitude` or `with_sign`) that the frame holds; the frame must outlive
  /// this. Stresses up to `least`, Pa, and those of round-off count as none.
  CellField(const Frame& frame, int cell, Field field, double least = 0);

  const Points& corners() const { return corners_; }
  /// The value at a point of the closed cell; 0 where it is not finite.
  double operator()(const Vec2& point);

 private:
  double stress_value(const Vec3& stress) const;
  double value(const Vec2& point);

  const Frame& frame_;
  Field field_;
  CellView view_;
  Points corners_;
  bool simple_;   ///< else the block's mean stands for the field
  double least_;  ///< stresses up to this are none, Pa
  polyfem::ShapeValues shape_;
};

}  // namespace ddacontact
