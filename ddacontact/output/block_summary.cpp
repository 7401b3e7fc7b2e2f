#include <ddacontact/output/block_summary.hpp>

#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>

namespace ddacontact {

Vec3 mean_stress(const Block& block, const BlockState& state) {
  const Tensors stress = block.stress(state);
  const VectorXd& weights = block.integration_weights();
  return stress * weights / weights.sum();
}

StressRange stress_range(const Block& block, const BlockState& state) {
  const Tensors stress = block.stress(state);
  StressRange range;
  range.mean = mean_stress(block, state);
  range.min = stress.rowwise().minCoeff();
  range.max = stress.rowwise().maxCoeff();
  for (Index q = 0; q < stress.cols(); ++q) {
    const polyfem::PrincipalStresses principal = polyfem::principal_stresses(stress.col(q));
    range.s1_max = q == 0 ? principal.s1 : std::max(range.s1_max, principal.s1);
    range.s2_min = q == 0 ? principal.s2 : std::min(range.s2_min, principal.s2);
  }
  return range;
}

}  // namespace ddacontact
