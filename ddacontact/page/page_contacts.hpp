/// \file Contacts of successive frames, each with a place of its own in a table.
#pragma once

#include <ddacontact/page/page_frame.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ddacontact {

/// All contacts of some frames, by vertex and edge block.
class PageContacts {
 public:
  explicit PageContacts(const std::vector<PageFrame>& frames);

  int n_contacts() const { return static_cast<int>(keys_.size()); }
  /// Appends the table: how many, then of each the place of its vertex and the edge's block, as differences.
  void append_table(std::string& bytes) const;
  /// Of a frame, for each contact of the table: 0 absent, 1 open, 2 stick, 3 and 4 slip forward and backward;
  /// and the direction of the normal, 4096 of a turn (that of the frame before where the contact is absent).
  const std::vector<std::int32_t>& states(int frame) const {
    return states_[static_cast<std::size_t>(frame)];
  }
  /// Normal and shear force of each, N per m; 0 where absent.
  const std::vector<double>& forces(int frame) const { return forces_[static_cast<std::size_t>(frame)]; }
  /// Gap of each, m; 0 where absent.
  const std::vector<double>& gaps(int frame) const { return gaps_[static_cast<std::size_t>(frame)]; }

 private:
  struct Key {
    int point = 0, edge_block = 0;
    int ordinal = 0;  ///< among contacts of one vertex with several edges of a block
    auto operator<=>(const Key&) const = default;
  };
  static std::vector<Key> keys_of(const Frame& frame);

  std::vector<Key> keys_;
  std::vector<std::vector<std::int32_t>> states_;
  std::vector<std::vector<double>> forces_, gaps_;
};

}  // namespace ddacontact
