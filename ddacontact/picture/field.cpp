#include <ddacontact/picture/field.hpp>

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr const char* sigma = "\u03c3";

const std::vector<FieldDescription> fields_at_points = {
    {Field::none, "none", {}, "", FieldKind::outlines},
    {Field::sxx, "sxx", {sigma, "xx", ""}, "Pa", FieldKind::with_sign},
    {Field::syy, "syy", {sigma, "yy", ""}, "Pa", FieldKind::with_sign},
    {Field::sxy, "sxy", {sigma, "xy", ""}, "Pa", FieldKind::with_sign},
    {Field::s1, "s1", {sigma, "1", ""}, "Pa", FieldKind::with_sign},
    {Field::s2, "s2", {sigma, "2", ""}, "Pa", FieldKind::with_sign},
    {Field::displacement, "displacement", {"displacement", "", ""}, "m", FieldKind::magnitude},
    {Field::velocity, "velocity", {"velocity", "", ""}, "m/s", FieldKind::magnitude},
    {Field::material, "material", {"material", "", ""}, "", FieldKind::kinds},
    {Field::block, "block", {"block", "", ""}, "", FieldKind::kinds}};

std::vector<FieldDescription> with_block_fields() {
  std::vector<FieldDescription> all = fields_at_points;
  for (const BlockField& field : block_fields())
    all.push_back(
        {static_cast<Field>(all.size()), field.name, {field.name, "", ""}, field.unit, FieldKind::with_sign});
  return all;
}

/// Strains below this are round-off.
constexpr double round_off = 1e-13;

/// What the block is as a whole, where its shape functions are of no use.
Eigen::VectorXd mean(const Frame& frame, int block, Field field) {
  const Range& range = frame.blocks[static_cast<std::size_t>(block)];
  if (field == Field::displacement)
    return frame.displacement.middleCols(range.first, range.count).rowwise().mean();
  if (field == Field::velocity) return frame.velocity.middleCols(range.first, range.count).rowwise().mean();
  return frame.mean_stress.col(block);
}

}  // namespace

const std::vector<FieldDescription>& all_fields() {
  static const std::vector<FieldDescription> all = with_block_fields();
  return all;
}

const FieldDescription& description(Field field) {
  return all_fields()[static_cast<std::size_t>(field)];
}

std::optional<Field> field_named(std::string_view name) {
  for (const FieldDescription& field : all_fields())
    if (name == field.name) return field.field;
  return std::nullopt;
}

bool holds(const Frame& frame, Field field) {
  const Index n = frame.position.cols();
  if (field >= Field::of_blocks) return frame.block_values.contains(description(field).name);
  if (is_stress(field))
    return frame.strain_displacement.cols() == static_cast<Index>(frame.corner_points.size());
  if (field == Field::displacement) return frame.displacement.cols() == n;
  if (field == Field::velocity) return frame.velocity.cols() == n;
  return true;
}

CellField::CellField(const Frame& frame, int cell, Field field, double least)
    : frame_(frame), field_(field), view_(frame, cell), corners_(view_.local_corners()), least_(0) {
  simple_ = &view_.basis() == &polyfem::wachspress || !polyfem::find_defect(corners_);
  if (is_stress(field))
    least_ = std::max(least,
                      round_off * frame.elasticity[static_cast<std::size_t>(view_.cell().elasticity)](0, 0));
}

double CellField::stress_value(const Vec3& stress) const {
  switch (field_) {
    case Field::sxx:
      return stress[0];
    case Field::syy:
      return stress[1];
    case Field::sxy:
      return stress[2];
    case Field::s1:
      return polyfem::principal_stresses(stress).s1;
    default:
      return polyfem::principal_stresses(stress).s2;
  }
}

double CellField::operator()(const Vec2& point) {
  const double found = value(point);
  return std::isfinite(found) && std::abs(found) > least_ ? found : 0;
}

double CellField::value(const Vec2& point) {
  if (field_ >= Field::of_blocks) return frame_.block_values.at(description(field_).name)[view_.cell().block];
  Eigen::VectorXd tensor;
  if (!simple_) {
    tensor = mean(frame_, view_.cell().block, field_);
  } else {
    view_.basis()(corners_, point, shape_);
    if (is_stress(field_))
      tensor = view_.stress(shape_);
    else
      tensor = view_.interpolate(field_ == Field::velocity ? frame_.velocity : frame_.displacement, shape_);
  }
  return is_stress(field_) ? stress_value(tensor) : tensor.norm();
}

}  // namespace ddacontact
