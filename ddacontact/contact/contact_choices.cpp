#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/detection/touching_edges.hpp>

namespace ddacontact {

std::vector<int> ContactBuilder::find_doubtful(const std::vector<Contact>& contacts, double least_force) {
  doubtful_.clear();
  for (const Choice& choice : choices_)
    for (const Contact& contact : of_same_pair(choice.chosen, contacts))
      if (choice.open && contact.pair == choice.chosen && contact.normal > least_force)
        doubtful_.insert(pair_of(contact));
  std::set<int> numbers;
  for (const Choice& choice : choices_)
    for (const Contact& contact : of_same_pair(choice.chosen, contacts))
      if (choice.open && contact.pair == choice.chosen && doubtful_.contains(pair_of(contact)))
        numbers.insert(static_cast<int>(&contact - contacts.data()));
  return {numbers.begin(), numbers.end()};
}

bool ContactBuilder::choose_again(const BlockState& state, const VectorXd& motion,
                                  const std::vector<ContactRecord>& previous,
                                  std::vector<Contact>& contacts) {
  std::set<Pair> pairs;
  for (const Choice& choice : choices_) pairs.insert(block_pair(choice.chosen));
  return choose_anew(pairs, state, motion, true, false, previous, contacts);
}

bool ContactBuilder::decide_doubtful(const BlockState& state, const VectorXd& without,
                                     const std::vector<ContactRecord>& previous,
                                     std::vector<Contact>& contacts) {
  const bool changed = choose_anew(doubtful_, state, without, ties_, true, previous, contacts);
  std::erase_if(choices_,
                [&](const Choice& choice) { return doubtful_.contains(block_pair(choice.chosen)); });
  return changed;
}

std::vector<CoveredPart> ContactBuilder::find_covered(const Pair& pair, const BlockState& state) const {
  std::vector<CoveredPart> covered;
  const double near = lip(pair[0], pair[1], true);
  const auto outline = [&](int b) { return blocks_.block(b).vertices().columns_of(state.position); };
  for (const int b : pair) {
    if (!blocks_.is_unchanging(b)) continue;
    const PointsRef own = outline(b);
    for (int c = 0; c < blocks_.n_blocks(); ++c) {
      const Vec2 shift = state.origin.col(c) - state.origin.col(b);
      const Box reach = widened(outlines_[b].box, search_margin_[b] + search_margin_[c]);
      if (c == pair[0] || c == pair[1] || !blocks_.is_unchanging(c) || !blocks_.is_present(c) ||
          !touch(reach, shifted(outlines_[c].box, shift)))
        continue;
      const Points third = outline(c).colwise() + shift;
      for (const TouchingEdges& part : touching_edges(own, third, near)) {
        const int e = static_cast<int>(part.edge), f = static_cast<int>(part.other), after_f = next(f, third);
        const Vec2 edge = along(own, e), start = own.col(e), end = own.col(next(e, own));
        if (edge.dot(along(third, f)) > 0) continue;
        const Vec2 past_start = third.col(after_f) - start, past_end = third.col(f) - end;
        covered.push_back({b, e, part.from * edge.norm(), part.to * edge.norm(),
                           past_start.norm() > near ? past_start : along(third, after_f),
                           past_end.norm() > near ? past_end : -along(third, previous(f, third))});
      }
    }
  }
  return covered;
}

bool ContactBuilder::choose_anew(const std::set<Pair>& pairs, const BlockState& state, const VectorXd& motion,
                                 bool ties, bool by_covers, const std::vector<ContactRecord>& previous,
                                 std::vector<Contact>& contacts) {
  std::erase_if(choices_, [&](const Choice& choice) { return pairs.contains(block_pair(choice.chosen)); });
  bool changed = false;
  std::vector<VertexEdge> found;
  for (const Pair& pair : pairs) {
    found.clear();
    const std::span<const ContactRecord> old = of_pair(pair, previous);
    find_contacts_of(pair, state, motion, old, ties,
                     by_covers ? find_covered(pair, state) : std::vector<CoveredPart>(), found, choices_);
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
