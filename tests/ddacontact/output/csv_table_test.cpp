// Tables and summaries read back what was written, and say what is wrong with what was not.

#include <ddacontact/output/csv_file.hpp>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/summary_reader.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace ddacontact;

class Tables : public testing::Test {
 protected:
  ~Tables() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  template <class Read>
  std::string error_of(Read&& read) const {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("polydda_tables_" + std::to_string(getpid()));
};

TEST_F(Tables, WhatIsWrittenIsReadBack) {
  const std::string awkward = "a \"quoted\", two\nlines";
  CsvFile csv(path_.string(), "name,value,count");
  const std::vector<double> numbers{
      0.1 + 0.2, -0., -1e-300, 5e-324, 1e-323, 1.7976931348623157e308, 1. / 3, 1e23, 123456789012345678.};
  csv.row(awkward, numbers[0], 3);
  for (std::size_t k = 1; k < numbers.size(); ++k) csv.row(std::string(), numbers[k], -7);
  csv.close();
  const CsvTable table(path_);
  ASSERT_EQ(table.n_rows(), numbers.size());
  EXPECT_EQ(table.texts("name")[0], awkward);
  EXPECT_EQ(table.texts("name")[1], "");
  EXPECT_EQ(table.numbers("value"), numbers);
  EXPECT_EQ(table.numbers("count")[0], 3);
  EXPECT_EQ(table.numbers("count")[1], -7);
}

TEST_F(Tables, WhatIsWrongIsNamed) {
  EXPECT_NE(error_of([&] { CsvTable{path_}; }).find("cannot read"), std::string::npos);
  write("");
  EXPECT_NE(error_of([&] { CsvTable{path_}; }).find("empty"), std::string::npos);
  write("a,b\n1,2\n3\n");
  EXPECT_NE(error_of([&] { CsvTable{path_}; }).find("row 2"), std::string::npos);
  write("a,b\n1,two\n");
  EXPECT_NE(error_of([&] { CsvTable(path_).numbers("b"); }).find("\"two\""), std::string::npos);
  EXPECT_NE(error_of([&] { CsvTable(path_).numbers("c"); }).find("no column \"c\""), std::string::npos);
}

TEST_F(Tables, SummariesAreFlattened) {
  write(R"({"status": "completed", "steps": 3, "energy": {"kinetic": 1.5}, "list": [1]})");
  const SummaryTable summary = read_summary(path_);
  EXPECT_EQ(summary.text("status"), "completed");
  EXPECT_EQ(summary.number("energy.kinetic"), 1.5);
  EXPECT_FALSE(summary.number("status"));
  EXPECT_FALSE(summary.number("list"));
  for (const char* damaged : {"", "{", "[1]", "{\"a\": }"}) {
    write(damaged);
    EXPECT_NE(error_of([&] { read_summary(path_); }).find("damaged"), std::string::npos) << damaged;
  }
}

}  // namespace
