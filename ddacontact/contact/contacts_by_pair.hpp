/// \file Contacts ordered by the pairs of their blocks.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace ddacontact {

/// The contacts of one pair of blocks stand together: ordered by the pair, then by contact.
inline Pair block_pair(const VertexEdge& contact) {
  return {std::min(contact.vertex_block, contact.edge_block),
          std::max(contact.vertex_block, contact.edge_block)};
}

/// The pair of a contact's blocks.
inline constexpr auto pair_of = [](const ContactRecord& of) { return block_pair(of.pair); };

/// The contacts of one pair, of contacts ordered by their pairs.
template <class SomeContact>
std::span<const SomeContact> of_pair(const Pair& pair, const std::vector<SomeContact>& contacts) {
  const auto first = std::ranges::lower_bound(contacts, pair, {}, pair_of);
  return {first, std::find_if(first, contacts.end(), [&](const auto& of) { return pair_of(of) != pair; })};
}
/// The contacts of the pair that a contact belongs to.
inline std::span<const Contact> of_same_pair(const VertexEdge& contact,
                                             const std::vector<Contact>& contacts) {
  return of_pair(block_pair(contact), contacts);
}

}  // namespace ddacontact
