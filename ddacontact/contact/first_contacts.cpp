// How contacts begin that touch when a run starts or a block comes in.
#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/contacts_by_pair.hpp>

#include <Eigen/QR>
#include <algorithm>

namespace ddacontact {

namespace {

/// The stress of a block at a point, from its centroid, before it has moved: of the affine field nearest to
/// the stress at its integration points.
Vec3 stress_at(const Block& block, const BlockState& state, const Vec2& point) {
  const Points points = block.integration_points();
  const Tensors stress = block.stress(state);
  const VectorXd& weights = block.integration_weights();
  const Vec3 mean = stress * weights / weights.sum();
  if (points.cols() == 1) return mean;
  const Points weighted = points * weights.asDiagonal();
  const Mat2 second = weighted * points.transpose();
  return mean + (stress.colwise() - mean) * weighted.transpose() *
                    second.completeOrthogonalDecomposition().solve(point);
}

}  // namespace

void ContactBuilder::load_joint(const BlockState& state, Contact& contact) const {
  const VertexEdgePositions at = contact.motion.slip_positions();
  const Vec2 place = state.origin.col(contact.pair.edge_block) + at.i;
  Vec3 stress = Vec3::Zero();
  int n_moving = 0;
  for (const int b : contact.pair.blocks())
    if (!blocks_.is_unchanging(b)) {
      stress += stress_at(blocks_.block(b), state, place - blocks_.block(b).centroid(state));
      ++n_moving;
    }
  if (stress.isZero(0)) return;
  const Vec2 along = at.along(), outwards = at.outwards();
  const Vec2 force =
      -contact.history.length / n_moving * (Mat2{{stress[0], stress[2]}, {stress[2], stress[1]}} * outwards);
  const double normal = force.dot(outwards);
  if (normal < -contact.law.tension) return;
  contact.history.normal = normal;
  contact.history.shear = force.dot(along);
  contact.history.gap_offset += normal / contact.law.normal_stiffness;
  contact.end_gap = contact.gap - contact.history.gap_offset;
}

void ContactBuilder::begin(const BlockState& state, std::span<const VertexEdge> found, bool comes_in,
                           Contact& contact) const {
  const double near = comes_in ? ContactProperties::default_lip : coincidence;
  ContactHistory& history = contact.history;
  if (contact.gap <= near * contact.size && contact.starts_on_edge()) {
    history.bonded = true;
    set_length(state, found, contact);
    history.gap_offset = comes_in || properties_.is_glued(contact) ? contact.gap : std::min(contact.gap, 0.0);
    contact.law = properties_.law(contact);
    history.state = contact.law.frictionless() ? ContactState::slip_forward : ContactState::stick;
    if (contact.law.compliant && !comes_in) load_joint(state, contact);
  }
  if (properties_.is_glued(contact)) glue(contact);
  if (!contact.law.compliant) leave_out_friction(contact);
}

std::vector<Contact> ContactBuilder::build_first(const BlockState& state, const VectorXd& motion,
                                                 const std::vector<double>& search_margin,
                                                 const std::vector<int>& coming) {
  std::vector<Contact> contacts;
  begins_ = true;
  contacts.reserve(detect(state, motion, search_margin, {}));
  begins_ = false;
  for (const auto& [found, choices] : found_in_)
    for (const VertexEdge& pair : found) {
      const std::span of_blocks = std::ranges::equal_range(found, block_pair(pair), {}, block_pair);
      contacts.push_back(make_contact(state, pair, of_blocks));
      begin(state, of_blocks, !coming.empty(), contacts.back());
    }
  return contacts;
}

void ContactBuilder::glue(Contact& contact) const {
  ContactHistory& history = contact.history;
  if (!contact.closed()) {
    if (std::abs(contact.gap - history.gap_offset) > coincidence * contact.size) return;
    if (!contact.starts_on_edge()) return;
    history.gap_offset = contact.gap;
  }
  history.state = ContactState::stick;
  contact.law = properties_.law(contact);
}

}  // namespace ddacontact
