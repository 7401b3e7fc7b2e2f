#include <ddacontact/page/page_contacts.hpp>

#include <ddacontact/page/byte_text.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace ddacontact {

namespace {

constexpr int directions = 4096;

int point_of(const Frame& frame, const FrameContact& contact) {
  Index vertex = 0;
  (frame.outline(contact.vertex_block).colwise() - contact.position)
      .colwise()
      .squaredNorm()
      .minCoeff(&vertex);
  return frame.blocks[static_cast<std::size_t>(contact.vertex_block)].first + static_cast<int>(vertex);
}

int state_number(ContactState state) {
  switch (state) {
    case ContactState::open:
      return 1;
    case ContactState::stick:
      return 2;
    case ContactState::slip_forward:
      return 3;
    default:
      return 4;
  }
}

/// The multiple of a full turn's 4096th nearest to the normal, as near to `before` as turns allow.
std::int32_t direction_number(const Vec2& normal, std::int32_t before) {
  const double turns = std::atan2(normal.y(), normal.x()) / (2 * std::numbers::pi);
  const auto number = static_cast<std::int32_t>(std::lround(turns * directions));
  const std::int32_t change = number - before;
  const double whole = std::round(static_cast<double>(change) / directions);
  return number - directions * static_cast<std::int32_t>(whole);
}

}  // namespace

std::vector<PageContacts::Key> PageContacts::keys_of(const Frame& frame) {
  std::set<Key> used;
  std::vector<Key> keys;
  for (const FrameContact& contact : frame.contacts) {
    Key key{point_of(frame, contact), contact.edge_block, 0};
    while (!used.insert(key).second) ++key.ordinal;
    keys.push_back(key);
  }
  return keys;
}

PageContacts::PageContacts(const std::vector<PageFrame>& frames) {
  std::vector<std::vector<Key>> of_frames;
  for (const PageFrame& shown : frames) {
    of_frames.push_back(keys_of(shown.frame));
    keys_.insert(keys_.end(), of_frames.back().begin(), of_frames.back().end());
  }
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());

  std::vector<std::int32_t> states(2 * keys_.size(), 0);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::vector<double> forces(2 * keys_.size(), 0), gaps(keys_.size(), 0);
    for (std::size_t k = 0; k < keys_.size(); ++k) states[2 * k] = 0;
    for (std::size_t c = 0; c < frames[f].frame.contacts.size(); ++c) {
      const FrameContact& contact = frames[f].frame.contacts[c];
      const auto k = static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), of_frames[f][c]) -
                                              keys_.begin());
      states[2 * k] = state_number(contact.state);
      states[2 * k + 1] = direction_number(contact.normal, states[2 * k + 1]);
      forces[2 * k] = contact.normal_force;
      forces[2 * k + 1] = contact.shear_force;
      gaps[k] = contact.gap;
    }
    states_.push_back(states);
    forces_.push_back(std::move(forces));
    gaps_.push_back(std::move(gaps));
  }
}

void PageContacts::append_table(std::string& bytes) const {
  append_integer(n_contacts(), bytes);
  Key before;
  for (const Key& key : keys_) {
    append_integer(key.point - before.point, bytes);
    append_integer(key.edge_block - before.edge_block, bytes);
    before = key;
  }
}

}  // namespace ddacontact
