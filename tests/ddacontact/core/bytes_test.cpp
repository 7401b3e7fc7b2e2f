#include <ddacontact/core/bytes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace ddacontact;

namespace {

enum class Colour : unsigned char { red, green };

/// One of each of what can be written.
struct Things {
  double number = 0;
  std::int64_t whole = 0;
  bool flag = false;
  Colour colour = Colour::red;
  std::string text;
  VectorXd vector;
  Points points;
  std::vector<int> list;

  template <class Some, class Visit>
  static void visit(Some& things, Visit& visit) {
    visit(things.number);
    visit(things.whole);
    visit(things.flag);
    visit(things.colour);
    visit(things.text);
    visit(things.vector);
    visit(things.points);
    visit.list(things.list, [&](auto& item) { visit(item); });
  }
};

Things some_things() {
  Things things{-0.0, -5, true, Colour::green, std::string("a\0b", 3), VectorXd(2), Points(2, 3), {7, 8, 9}};
  things.vector << 0.1, std::numeric_limits<double>::infinity();
  things.points << 1, 2, 3, 4, 5, 6;
  return things;
}

std::string bytes_of(const Things& things) {
  ByteWriter writer;
  Things::visit(things, writer);
  return writer.bytes;
}

Things things_from(std::string_view bytes) {
  ByteReader reader(bytes);
  Things things;
  Things::visit(things, reader);
  reader.expect_end();
  return things;
}

template <class Matrix>
Matrix read(const std::string& bytes) {
  Matrix matrix;
  ByteReader{bytes}(matrix);
  return matrix;
}

/// Of a matrix, and one number.
std::string dimensions(Index rows, Index cols) {
  ByteWriter writer;
  writer(rows);
  writer(cols);
  writer(1.0);
  return writer.bytes;
}

}  // namespace

TEST(Bytes, GiveBackWhatWasWrittenToTheBit) {
  const Things before = some_things(), after = things_from(bytes_of(before));
  EXPECT_TRUE(after.number == 0 && std::signbit(after.number));
  EXPECT_EQ(after.whole, -5);
  EXPECT_TRUE(after.flag);
  EXPECT_EQ(after.colour, Colour::green);
  EXPECT_EQ(after.text, before.text);
  EXPECT_EQ(after.vector, before.vector);
  EXPECT_EQ(after.points, before.points);
  EXPECT_EQ(after.list, before.list);
  EXPECT_EQ(bytes_of(after), bytes_of(before));
  EXPECT_EQ(bytes_of(things_from(bytes_of(Things()))), bytes_of(Things())) << "of nothing";
}

TEST(Bytes, AnyThatAreMissingAreRefused) {
  const std::string bytes = bytes_of(some_things());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(things_from(std::string_view(bytes).substr(0, size)), Error) << size;
}

TEST(Bytes, AnyTooManyAreRefused) {
  EXPECT_THROW(things_from(bytes_of(some_things()) + '\0'), Error);
}

/// Three rows where two are known, and sizes that no such bytes have: nothing is reserved for them.
TEST(Bytes, SizesThatCannotBeAreRefused) {
  ByteWriter three_rows;
  three_rows(Mat3(Mat3::Identity()));
  EXPECT_EQ(read<MatrixXd>(three_rows.bytes), Mat3::Identity());
  EXPECT_THROW(read<Points>(three_rows.bytes), Error);
  EXPECT_THROW(read<VectorXd>(three_rows.bytes), Error);
  const Index most = std::numeric_limits<Index>::max();
  for (const auto& [rows, cols] :
       {std::pair<Index, Index>{-1, 1}, {1, -1}, {most, 1}, {Index{1} << 62, 4}, {1, most}})
    EXPECT_THROW(read<MatrixXd>(dimensions(rows, cols)), Error) << rows << ' ' << cols;
  EXPECT_EQ(read<MatrixXd>(dimensions(0, 5)).cols(), 5);
  ByteWriter long_list;
  long_list(most);
  std::vector<int> list;
  ByteReader reader(long_list.bytes);
  EXPECT_THROW(reader.list(list, [](int&) {}), Error);
}
