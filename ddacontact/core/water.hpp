/// \file Water at rest, by its table.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Water below a table. Its pressure is the unit weight of water times the depth below the table, whatever
/// the table's slope: flow is not computed.
struct Water {
  Points table;           ///< m, x ascending, constant beyond its ends; empty: no water
  Points joint_table;     ///< the same for faces that touch another block; empty: no water in joints
  double density = 1000;  ///< kg/m3

  bool any() const { return table.cols() > 0 || joint_table.cols() > 0; }
  /// Whether it matters which faces touch another block.
  bool tells_joints() const { return !same(table, joint_table); }
  bool operator==(const Water& other) const {
    return same(table, other.table) && same(joint_table, other.joint_table) && density == other.density;
  }

 private:
  static bool same(const Points& a, const Points& b) { return a.cols() == b.cols() && a == b; }
};

}  // namespace ddacontact
