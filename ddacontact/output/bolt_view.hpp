/// \file A bolt in a state, as results tell of it.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/equations/bolt_law.hpp>

namespace ddacontact {

/// Forces and states of the segments of a bolt.
class BoltView {
 public:
  BoltView(const Bolt& bolt, const BlockSystem& blocks, const BlockState& state);

  /// N per m, tension positive; 0 where the segment bears nothing.
  double axial(int segment) const { return bears_ ? forces_.axial[segment] : 0; }
  /// Of the bar since it was installed, m.
  double elongation(int segment) const;
  /// "absent" (not installed as yet), "torn", "yield" (its force is at its bound), "buckled" (its
  /// compression is), "slip" (the bond at one of its ends is) or "elastic".
  const char* state(int segment) const;
  bool is_torn(int segment) const { return bears_ && numbers_[Bolt::torn(segment)] != 0; }
  /// That with the largest force, the first of equals; -1 where no segment is left.
  int most_loaded() const;

 private:
  bool slips(int node) const;

  const Bolt& bolt_;
  bool bears_;
  VectorXd numbers_, of_rock_;
  BoltForces forces_;
};

}  // namespace ddacontact
