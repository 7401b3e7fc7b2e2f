#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/core/for_all.hpp>
#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/missed_penetrations.hpp>

#include <algorithm>
#include <iterator>

namespace ddacontact {

bool ContactBuilder::may_penetrate(int a, int b, const BlockState& end) const {
  const Range& of_a = blocks_.block(a).vertices();
  const Vec2 shift = end.origin.col(a) - end.origin.col(b);
  const Box within = widened(boxes_[b], -lip(a, b, true) / 2);
  for (int v = of_a.first; v < of_a.end(); ++v) {
    const Vec2 x = end.position.col(v) + shift;
    if (touch({x, x}, within)) return true;
  }
  return false;
}

Points ContactBuilder::contact_outline(const BlockState& state, int block) const {
  const PointsRef outline = blocks_.block(block).outline(state);
  if (!blocks_.has_rounded_corners()) return outline;
  Points centres(2, outline.cols());
  for (int k = 0; k < outline.cols(); ++k)
    centres.col(k) =
        blocks_.rounded(block).corners[k].centre.at(outline.col(k), outline.col(next(k, outline)));
  return centres;
}

bool ContactBuilder::find_missed(const BlockState& start, const BlockState& end,
                                 const std::vector<Contact>& contacts) {
  missed_.clear();
  for_all(blocks_.n_blocks(), [&](int b) { boxes_[b] = bounding_box(blocks_.block(b).outline(end)); });
  for (const auto& [a, b] : pairs_) {
    if (!may_penetrate(a, b, end) && !may_penetrate(b, a, end)) continue;
    const auto from_origin_of_a = [&, origin = start.origin.col(a)](const BlockState& state, int block) {
      const Vec2 shift = state.origin.col(block) - origin;
      return Points(contact_outline(state, block).colwise() + shift);
    };
    const Points start_a = from_origin_of_a(start, a), end_a = from_origin_of_a(end, a),
                 start_b = from_origin_of_a(start, b), end_b = from_origin_of_a(end, b);
    find_missed_penetrations({a, start_a, end_a}, {b, start_b, end_b}, lip(a, b, false), missed_);
  }
  // What supports alone press into each other has no force that one could tell.
  std::erase_if(missed_, [&](const VertexEdge& entry) {
    return !blocks_.is_free(entry.vertex_block) && !blocks_.is_free(entry.edge_block) &&
           !properties_.strength(entry).is_compliant() && !can_change(start, entry, {});
  });
  std::erase_if(missed_, [&](const VertexEdge& entry) {
    return std::ranges::any_of(of_same_pair(entry, contacts), [&](const Contact& of) {
      return of.pair == entry || are_at_one_place(start, of.pair, entry);
    });
  });
  return !missed_.empty();
}

void ContactBuilder::add_missed(const BlockState& start, std::vector<Contact>& contacts) {
  for (const VertexEdge& entry : missed_) {
    const std::span<const Contact> same = of_same_pair(entry, contacts);
    if (std::ranges::find(same, entry, &Contact::pair) != same.end()) continue;
    std::vector<VertexEdge> of_blocks(missed_);
    std::ranges::transform(same, std::back_inserter(of_blocks), &Contact::pair);
    contacts.insert(std::ranges::upper_bound(contacts, block_pair(entry), {}, pair_of),
                    make_contact(start, entry, of_blocks));
  }
  // The path has told which line these corners pass: for the rest of the step it is not chosen again.
  std::erase_if(choices_, [this](const Choice& choice) {
    return std::ranges::any_of(
        missed_, [&](const VertexEdge& entry) { return block_pair(entry) == block_pair(choice.chosen); });
  });
}

}  // namespace ddacontact
