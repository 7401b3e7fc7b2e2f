#include <gtest/gtest.h>
#include <polyfem/core/error.hpp>
#include <polyfem/io/vtu_reader.hpp>

#include <fstream>
#include <random>

using namespace polyfem;

namespace {

class VtuFileTest : public testing::Test {
 protected:
  ~VtuFileTest() override { std::filesystem::remove(path); }

  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("vtu_file_test" + std::to_string(std::random_device()()));
  std::vector<double> coordinates{0, 0, 0, 1, 0, 0, 0, 1, -0.0, 5e300, 1e-310, 2};
  std::vector<std::int32_t> ids{1, -2, 2147483647, 0};
  std::vector<std::int64_t> large{1, -(1LL << 62)};
  std::vector<std::uint8_t> text{'a', 0, 255};

  void write() const {
    VtuFile file;
    file.set_points(coordinates);
    file.set_cells(std::vector<std::int64_t>{0, 1, 2, 3}, std::vector<std::int64_t>{3, 4},
                   std::vector{VtkCell::triangle, VtkCell::vertex});
    file.add(VtuSection::point_data, "place", coordinates, 3);
    file.add(VtuSection::point_data, "id", ids);
    file.add(VtuSection::cell_data, "large", large);
    file.add(VtuSection::field_data, "text", text);
    file.add(VtuSection::field_data, "nothing", std::vector<double>());
    file.write(path);
  }
  std::string bytes() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(VtuFileTest, EveryTypeIsReadBackBitForBit) {
  write();
  const VtuReader file(path);
  EXPECT_EQ(file.n_points(), 4u);
  EXPECT_EQ(file.n_cells(), 2u);
  EXPECT_EQ(file.points(), coordinates);
  EXPECT_TRUE(std::signbit(file.points()[8]));
  EXPECT_EQ(file.read<double>(VtuSection::point_data, "place", 3), coordinates);
  EXPECT_EQ(file.read<std::int32_t>(VtuSection::point_data, "id"), ids);
  EXPECT_EQ(file.read<std::int64_t>(VtuSection::cell_data, "large"), large);
  EXPECT_EQ(file.read<std::uint8_t>(VtuSection::field_data, "text"), text);
  EXPECT_TRUE(file.read<double>(VtuSection::field_data, "nothing").empty());
  EXPECT_TRUE(file.has(VtuSection::point_data, "id"));
  EXPECT_FALSE(file.has(VtuSection::cell_data, "id"));
}

TEST_F(VtuFileTest, AskingForWhatIsNotThereNamesFileAndArray) {
  write();
  const VtuReader file(path);
  const auto expect_message = [&](auto&& read, const char* word) {
    try {
      read();
      ADD_FAILURE() << word;
    } catch (const FileError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(path.string()), std::string::npos) << message;
      EXPECT_NE(message.find(word), std::string::npos) << message;
    }
  };
  expect_message([&] { file.read<double>(VtuSection::point_data, "other"); }, "\"other\"");
  expect_message([&] { file.read<double>(VtuSection::point_data, "id"); }, "Float64");
  expect_message([&] { file.read<std::int32_t>(VtuSection::point_data, "id", 2); }, "2 components");
  std::filesystem::remove(path);
  expect_message([&] { VtuReader again(path); }, "No such file");
}

TEST_F(VtuFileTest, ArraysMustBeAsLongAsThereArePointsOrCells) {
  VtuFile file;
  file.set_points(coordinates);
  file.add(VtuSection::point_data, "short", large);
  file.write(path);
  EXPECT_THROW(VtuReader(path).read<std::int64_t>(VtuSection::point_data, "short"), FileError);
}

TEST_F(VtuFileTest, WhatCannotBeWrittenIsAnErrorAndLeavesNoFile) {
  EXPECT_THROW(VtuFile().write("/nowhere/at/all.vtu"), FileError);
  EXPECT_THROW(VtuFile().write("/dev/full"), FileError);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  EXPECT_THROW(VtuReader("/nowhere/at/all.vtu"), FileError);
  EXPECT_THROW(VtuReader("/"), FileError);
}

TEST_F(VtuFileTest, DamagedFilesAreErrorsOrRead) {
  write();
  const std::string whole = bytes();
  const auto read_everything = [&] {
    const VtuReader file(path);
    file.points();
    file.read<double>(VtuSection::point_data, "place", 3);
    file.read<std::int64_t>(VtuSection::cell_data, "large");
    file.read<std::uint8_t>(VtuSection::field_data, "text");
  };
  std::mt19937 random(11);
  for (int k = 0; k < 2000; ++k) {
    std::string damaged = whole;
    if (k % 4 == 0)
      damaged.resize(random() % whole.size());
    else
      damaged[random() % whole.size()] = static_cast<char>(random());
    std::filesystem::remove(path);  // replacing a file's contents is slow on some file systems
    std::ofstream(path, std::ios::binary) << damaged;
    try {
      read_everything();
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

}  // namespace
