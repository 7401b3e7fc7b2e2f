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
inline constexpr auto pair_of = [](const Contact& of) { return block_pair(of.pair); };

/// Of contacts ordered by their pairs, those of one.
inline std::span<const Contact> of_pair(const Pair& pair, const std::vector<Contact>& contacts) {
  return {std::ranges::lower_bound(contacts, pair, {}, pair_of),
          std::ranges::upper_bound(contacts, pair, {}, pair_of)};
}
/// Those of the pair of a contact.
inline std::span<const Contact> of_same_pair(const VertexEdge& contact,
                                             const std::vector<Contact>& contacts) {
  return of_pair(block_pair(contact), contacts);
}

/// Of contacts ordered by their pairs, those of one pair after the other.
class ContactsByPair {
 public:
  /// Pairs from `first` on, in order.
  ContactsByPair(const std::vector<ContactRecord>& contacts, const Pair& first)
      : end_(contacts.data() + contacts.size()),
        from_(std::lower_bound(
            contacts.data(), end_, first,
            [](const ContactRecord& contact, const Pair& pair) { return block_pair(contact.pair) < pair; })),
        to_(from_) {}

  std::span<const ContactRecord> of(const Pair& pair) {
    if (from_ != to_ && block_pair(from_->pair) == pair) return {from_, to_};
    for (from_ = to_; from_ != end_ && block_pair(from_->pair) < pair;) ++from_;
    for (to_ = from_; to_ != end_ && block_pair(to_->pair) == pair;) ++to_;
    return {from_, to_};
  }

 private:
  const ContactRecord *end_, *from_, *to_;
};

}  // namespace ddacontact
