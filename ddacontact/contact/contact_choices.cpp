#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/contacts_by_pair.hpp>

#include <limits>

namespace ddacontact {

/// A corner that was asked is where it was until it has slipped by half the digits of its block's size.
constexpr double least_slip = std::numeric_limits<float>::epsilon();

std::vector<int> ContactBuilder::find_doubtful(std::vector<Contact>& contacts, double least_force,
                                               bool kept_too) {
  doubtful_.clear();
  asks_kept_ = kept_too;
  std::set<int> open;
  for (const Choice& choice : choices_)
    for (const Contact& contact : of_same_pair(choice.chosen, contacts))
      if (choice.open && contact.pair == choice.chosen &&
          (!choice.kept ||
           (kept_too && !contact.has_bond() && contact.since_asked > least_slip * contact.size)))
        open.insert(static_cast<int>(&contact - contacts.data()));
  for (const int c : open)
    if (contacts[c].normal > least_force) doubtful_.insert(pair_of(contacts[c]));
  std::erase_if(open, [&](int c) { return !doubtful_.contains(pair_of(contacts[c])); });
  for (const int c : open)
    if (asks_kept_) contacts[c].since_asked = 0;
  return {open.begin(), open.end()};
}

bool ContactBuilder::choose_again(const BlockState& state, const VectorXd& motion,
                                  const std::vector<ContactRecord>& previous,
                                  std::vector<Contact>& contacts) {
  std::set<Pair> pairs;
  for (const Choice& choice : choices_) pairs.insert(block_pair(choice.chosen));
  return choose_anew(pairs, state, motion, previous, contacts);
}

bool ContactBuilder::decide_doubtful(const BlockState& state, const VectorXd& without,
                                     const std::vector<ContactRecord>& previous,
                                     std::vector<Contact>& contacts) {
  const bool changed = choose_anew(doubtful_, state, without, previous, contacts);
  std::erase_if(choices_,
                [&](const Choice& choice) { return doubtful_.contains(block_pair(choice.chosen)); });
  for (Contact& contact : contacts)
    if (asks_kept_ && doubtful_.contains(pair_of(contact))) contact.since_asked = 0;
  return changed;
}

bool ContactBuilder::choose_anew(const std::set<Pair>& pairs, const BlockState& state, const VectorXd& motion,
                                 const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts) {
  std::erase_if(choices_, [&](const Choice& choice) { return pairs.contains(block_pair(choice.chosen)); });
  bool changed = false;
  for (const Pair& pair : pairs) {
    FoundContacts anew;
    const std::span<const ContactRecord> old = of_pair(pair, previous);
    find_contacts_of(pair, state, motion, old, anew);
    const std::vector<VertexEdge>& found = anew.contacts;
    choices_.insert(choices_.end(), anew.choices.begin(), anew.choices.end());
    const std::span<const Contact> before = of_pair(pair, contacts);
    if (std::ranges::equal(before, found, {}, &Contact::pair)) continue;
    changed = true;
    std::vector<Contact> chosen;
    for (const VertexEdge& of : found) {
      const auto same = std::ranges::find(before, of, &Contact::pair);
      chosen.push_back(same != before.end() ? *same : carry_over(state, of, found, old));
    }
    const auto first = contacts.begin() + (before.data() - contacts.data());
    const auto at = contacts.erase(first, first + static_cast<std::ptrdiff_t>(before.size()));
    contacts.insert(at, chosen.begin(), chosen.end());
  }
  return changed;
}

}  // namespace ddacontact
