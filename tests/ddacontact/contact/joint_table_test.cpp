#include <ddacontact/contact/joint_table.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

using Entries = std::vector<JointTable::Entry>;
using Pair = std::array<int, 2>;

}  // namespace

TEST(JointTable, NamedPairsWinInEitherOrderWhereverTheyStand) {
  const JointTable table(Entries{{{1, 0, 0}, {}}, {{2, 0, 0}, Pair{0, 1}}, {{3, 0, 0}, Pair{2, 2}}});
  EXPECT_EQ(table.between(0, 1).friction, 2);
  EXPECT_EQ(table.between(1, 0).friction, 2);
  EXPECT_EQ(table.between(2, 2).friction, 3);
  for (const Pair& other : {Pair{0, 0}, Pair{1, 1}, Pair{0, 2}, Pair{2, 1}, Pair{5, 7}})
    EXPECT_EQ(table.between(other[0], other[1]).friction, 1);
}

TEST(JointTable, TheFirstGeneralJointIsTheDefaultAlsoBehindNamedOnes) {
  const JointTable table(Entries{{{2, 0, 0}, Pair{0, 1}}, {{5, 0, 0}, {}}, {{6, 0, 0}, {}}});
  EXPECT_EQ(table.between(0, 0).friction, 5);
  EXPECT_EQ(table.between(0, 1).friction, 2);
}

TEST(JointTable, WithoutAGeneralJointTheFirstIsTheDefault) {
  const JointTable table(Entries{{{2, 0, 0}, Pair{0, 1}}, {{5, 0, 0}, Pair{0, 2}}});
  EXPECT_EQ(table.between(3, 3).friction, 2);
  EXPECT_EQ(table.between(2, 0).friction, 5);
}

TEST(JointTable, OfTwoEntriesForOnePairTheFirstHolds) {
  const JointTable table(Entries{{{1, 0, 0}, {}}, {{2, 0, 0}, Pair{0, 1}}, {{3, 0, 0}, Pair{1, 0}}});
  EXPECT_EQ(table.between(1, 0).friction, 2);
}
