#include <ddacontact/output/buckling.hpp>

#include <ddacontact/output/block_summary.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <Eigen/Eigenvalues>

#include <numbers>

namespace ddacontact {

namespace {

/// Thrust over pi^2 E I / L^2, with E and L of a rectangle of the same second moments.
double part_of_euler_load(const Block& block, const BlockState& state) {
  const polyfem::AreaMoments moments = polyfem::area_moments(block.outline(state));
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(moments.second);
  const Vec2 along = axes.eigenvectors().col(1);
  const Vec3 stress = mean_stress(block, state);
  const double pressure = -(along.x() * along.x() * stress[0] + along.y() * along.y() * stress[1] +
                            2 * along.x() * along.y() * stress[2]);
  const Mat3& D = block.material().elasticity;
  const double E = D(0, 0) - D(0, 1) * D(1, 0) / D(1, 1),
               slenderness = 12 * axes.eigenvalues()[1] / axes.eigenvalues()[0];  // A L^2 / I
  return pressure * slenderness / (std::numbers::pi * std::numbers::pi * E);
}

}  // namespace

Buckling nearest_to_buckling(const BlockSystem& blocks, const BlockState& state, bool follows_cells) {
  Buckling nearest;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    if (!blocks.is_movable(b) || !blocks.is_present(b) || (follows_cells && block.n_cells() > 1)) continue;
    const double part = part_of_euler_load(block, state);
    if (part > nearest.of_critical) nearest = {b, part};
  }
  return nearest;
}

}  // namespace ddacontact
