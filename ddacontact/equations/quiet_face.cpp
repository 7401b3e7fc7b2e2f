#include <ddacontact/equations/quiet_face.hpp>

#include <ddacontact/core/sort_once.hpp>

#include <algorithm>
#include <array>

namespace ddacontact {

StepQuietFace::StepQuietFace(const BlockSystem& blocks, const QuietFace& face) : face_(&face) {
  const Block& block = blocks.block(face.block);
  const std::array maps{block.vertex_map(face.edge), block.vertex_map((face.edge + 1) % block.n_vertices())};
  for (const PointMap& map : maps)
    map.for_terms([&](int unknown, const Vec2&) { unknowns_.push_back(unknown); });
  sort_once(unknowns_);
  for (int end = 0; end < 2; ++end) {
    ends_[end].setZero(2, unknowns_.size());
    maps[end].for_terms([&](int unknown, const Vec2& column) {
      ends_[end].col(std::ranges::lower_bound(unknowns_, unknown) - unknowns_.begin()) = column;
    });
  }
}

void StepQuietFace::begin(const BlockSystem& blocks, const BlockState& state, const StepStart& start) {
  const Mat2 at_end = blocks.impedance_at_ends(*face_, state);
  damping_ = ends_[0].transpose() * at_end * ends_[0] + ends_[1].transpose() * at_end * ends_[1];
  const double of_step = start.rule.starts_at_rest ? 0 : start.rule.has_half_steps() ? 0.5 : 1;
  by_displacement_ = of_step / start.dt;
  before_ = (start.rule.starts_at_rest ? 0 : 1 - of_step) * start.velocity(unknowns_);
}

void StepQuietFace::add_forces(const VectorXd& d, VectorXd& F) const {
  F(unknowns_) -= damping_ * (before_ + by_displacement_ * d(unknowns_));
}

}  // namespace ddacontact
