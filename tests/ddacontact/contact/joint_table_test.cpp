#include <ddacontact/contact/joint_table.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

using Entries = std::vector<JointTable::Entry>;
using Pair = std::array<int, 2>;

double friction_between(const JointTable& table, int a, int b) {
  return table.entries()[table.number_between(a, b)].strength.friction;
}

}  // namespace

TEST(JointTable, NamedPairsWinInEitherOrderWhereverTheyStand) {
  const JointTable table(Entries{{{1, 0, 0}, {}}, {{2, 0, 0}, Pair{0, 1}}, {{3, 0, 0}, Pair{2, 2}}});
  EXPECT_EQ(friction_between(table, 0, 1), 2);
  EXPECT_EQ(friction_between(table, 1, 0), 2);
  EXPECT_EQ(friction_between(table, 2, 2), 3);
  for (const Pair& other : {Pair{0, 0}, Pair{1, 1}, Pair{0, 2}, Pair{2, 1}, Pair{5, 7}})
    EXPECT_EQ(friction_between(table, other[0], other[1]), 1);
}

TEST(JointTable, TheFirstGeneralJointIsTheDefaultAlsoBehindNamedOnes) {
  const JointTable table(Entries{{{2, 0, 0}, Pair{0, 1}}, {{5, 0, 0}, {}}, {{6, 0, 0}, {}}});
  EXPECT_EQ(friction_between(table, 0, 0), 5);
  EXPECT_EQ(friction_between(table, 0, 1), 2);
}

TEST(JointTable, WithoutAGeneralJointTheFirstIsTheDefault) {
  const JointTable table(Entries{{{2, 0, 0}, Pair{0, 1}}, {{5, 0, 0}, Pair{0, 2}}});
  EXPECT_EQ(friction_between(table, 3, 3), 2);
  EXPECT_EQ(friction_between(table, 2, 0), 5);
}

TEST(JointTable, OfTwoEntriesForOnePairTheFirstHolds) {
  const JointTable table(Entries{{{1, 0, 0}, {}}, {{2, 0, 0}, Pair{0, 1}}, {{3, 0, 0}, Pair{1, 0}}});
  EXPECT_EQ(friction_between(table, 1, 0), 2);
}
