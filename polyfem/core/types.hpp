/// \file The few types everything else is written in.
#pragma once

#include <Eigen/Core>

/// Finite elements on polygons.
namespace polyfem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A point or a vector of the plane.
using Vec2 = Eigen::Vector2d;
/// Plane stress or strain components in the order (xx, yy, xy); strains carry gamma_xy = 2 eps_xy (8), (10).
using Vec3 = Eigen::Vector3d;
/// A tensor of the plane.
using Mat2 = Eigen::Matrix2d;
/// A linear map of stress or strain components, as D of (9).
using Mat3 = Eigen::Matrix3d;

/// Points in the plane, one a column. A polygon is the columns of its vertices in counter-clockwise order;
/// edge k runs from vertex k to vertex k + 1.
using Points = Eigen::Matrix2Xd;
/// A view of points: a whole Points or a range of its columns, without a copy.
using PointsRef = Eigen::Ref<const Points>;
/// Stresses or strains at points, one (xx, yy, xy) a column.
using Tensors = Eigen::Matrix3Xd;
/// A view of tensors: a whole Tensors or a range of its columns, without a copy.
using TensorsRef = Eigen::Ref<const Tensors>;

/// z component of the cross product: twice the area of the triangle (0, a, b), > 0 when b lies left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace polyfem
