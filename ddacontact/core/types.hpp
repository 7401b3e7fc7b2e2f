/// \file The types of polyfem under this library's name.
#pragma once

#include <polyfem/core/error.hpp>
#include <polyfem/core/types.hpp>

#include <limits>

/// Discontinuous deformation analysis: systems of deformable blocks in contact.
namespace ddacontact {

using polyfem::cross;
using polyfem::Error;
using polyfem::Index;
using polyfem::Mat2;
using polyfem::Mat3;
using polyfem::MatrixXd;
using polyfem::Points;
using polyfem::PointsRef;
using polyfem::Tensors;
using polyfem::TensorsRef;
using polyfem::Vec2;
using polyfem::Vec3;
using polyfem::VectorXd;

/// A vector as an argument.
using VectorIn = Eigen::Ref<const VectorXd>;
/// A vector that is written to.
using VectorOut = Eigen::Ref<VectorXd>;

/// Infinity.
inline constexpr double inf = std::numeric_limits<double>::infinity();

/// Consecutive entries of an array that belong to one block.
struct Range {
  int first = 0, count = 0;
  int end() const { return first + count; }
  /// These entries of a vector, and these columns of a matrix.
  auto of(auto&& vector) const { return vector.segment(first, count); }
  auto columns_of(auto&& matrix) const { return matrix.middleCols(first, count); }
};

}  // namespace ddacontact
