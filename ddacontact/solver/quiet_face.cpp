#include <ddacontact/solver/quiet_face.hpp>

#include <algorithm>

namespace ddacontact {

StepQuietFace::StepQuietFace(const BlockSystem& blocks, const QuietFace& face) : face_(&face) {
  const Block& block = blocks.block(face.block);
  AffineForm forms[2][2];  // of both ends, by axis
  for (int end = 0; end < 2; ++end)
    for (int axis = 0; axis < 2; ++axis) {
      AffineForm& form = forms[end][axis];
      block.vertex_map((face.edge + end) % block.n_vertices()).add_to(form, Vec2::Unit(axis));
      unknowns_.insert(unknowns_.end(), form.unknowns().begin(), form.unknowns().end());
    }
  std::ranges::sort(unknowns_);
  unknowns_.erase(std::unique(unknowns_.begin(), unknowns_.end()), unknowns_.end());
  for (int end = 0; end < 2; ++end) {
    ends_[end].setZero(2, static_cast<Index>(unknowns_.size()));
    for (int axis = 0; axis < 2; ++axis)
      for (std::size_t k = 0; k < forms[end][axis].unknowns().size(); ++k)
        ends_[end](axis, std::ranges::lower_bound(unknowns_, forms[end][axis].unknowns()[k]) -
                             unknowns_.begin()) = forms[end][axis].coefficients()[k];
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
