/// \file Forces and tangent of an element of any material under small strains.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

#include <functional>

namespace polyfem {

/// The stress at integration point q for a strain (xx, yy, gamma_xy), and the symmetric tangent d stress / d
/// strain.
using PointStress = std::function<Vec3(Index q, const Vec3& strain, Mat3& tangent)>;

/// forces = integral of B^T sigma(B d), K = d forces / d d, 2n and 2n x 2n, both overwritten; elements of
/// either order.
void small_strain_forces(const TabulatedElement& element, const PointStress& material,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces);

}  // namespace polyfem
