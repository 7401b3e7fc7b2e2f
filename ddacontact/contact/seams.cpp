#include <ddacontact/contact/seams.hpp>

#include <ddacontact/detection/contact_length.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ddacontact {

namespace {

struct OnEdge {
  int edge_block, edge;
  double along;  ///< from the start of the edge, m
  Contact* contact;
};

}  // namespace

void share_friction_at_seams(const BlockSystem& blocks, const BlockState& state,
                             const ContactProperties& properties, std::vector<Contact>& contacts) {
  const auto is_general = [](const JointTable::Entry& joint) { return !joint.between; };
  if (std::ranges::all_of(properties.joints.entries(), is_general)) return;
  std::vector<OnEdge> corners;
  for (Contact& contact : contacts) {
    if (contact.law.compliant || contact.law.friction_law || contact.pair.corner) continue;
    const VertexEdgePositions& at = contact.motion.start;
    corners.push_back(
        {contact.pair.edge_block, contact.pair.edge, (at.k - at.j).normalized().dot(at.i - at.j), &contact});
  }
  std::ranges::sort(corners, {},
                    [](const OnEdge& of) { return std::tuple(of.edge_block, of.edge, of.along); });
  const auto length = [&](const VertexEdge& pair) {
    const Block& block = blocks.block(pair.vertex_block);
    return contact_length(blocks.outline_from(state, pair.vertex_block, pair.edge_block),
                          blocks.outline_from(state, pair.edge_block, pair.edge_block), pair,
                          block.reference().leftCols(block.n_vertices()), [](int, int) { return false; })
        .total();
  };
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const OnEdge &one = corners[k - 1], &other = corners[k];
    Contact &a = *one.contact, &b = *other.contact;
    const double same_place = properties.lip * std::min(a.size, b.size);
    if (std::pair(one.edge_block, one.edge) != std::pair(other.edge_block, other.edge) ||
        a.pair.vertex_block == b.pair.vertex_block || a.law.friction == b.law.friction ||
        !blocks.is_held(a.pair.vertex_block) || !blocks.is_held(b.pair.vertex_block) ||
        other.along - one.along > same_place || std::abs(a.gap - b.gap) > same_place)
      continue;
    const double of_a = length(a.pair), of_b = length(b.pair);
    if (of_a > 0 && of_b > 0)
      a.law.friction = b.law.friction = (of_a * a.law.friction + of_b * b.law.friction) / (of_a + of_b);
  }
}

}  // namespace ddacontact
