// What is computed from measurements before it goes to a page.
#include <tests/performance/page/convergence.hpp>
#include <tests/performance/page/marked_page.hpp>

#include <gtest/gtest.h>
#include <polyfem/core/error.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace benchmark_page;

namespace {

/// Errors h^2 and 3 h on n x n cells, each in n^2 seconds.
std::vector<Measurement> exact_powers(const std::string& solver, double slowness = 1) {
  std::vector<Measurement> table;
  for (const int n : {4, 8, 16}) {
    const double h = 1. / n;
    table.push_back(
        {"problem", "method", solver, n * n, 2 * n * n, h * h, 3 * h, 9, 0, 0, slowness * n * n, 0});
  }
  return table;
}

TEST(Convergence, RatesOfPowersAreTheirExponents) {
  const Series series{"method", exact_powers("a")};
  EXPECT_NEAR(rate(series, &Measurement::l2), 2, 1e-12);
  EXPECT_NEAR(rate(series, &Measurement::energy), 1, 1e-12);
}

TEST(Convergence, TimeToAnErrorIsInterpolatedInLogarithms) {
  const Series series{"method", exact_powers("a")};  // time = 1 / error
  for (const double error : {1. / 20, 1. / 64, 1. / 200, 1. / 256})
    EXPECT_NEAR(*time_to_reach(series, &Measurement::l2, error), 1 / error, 1e-9 / error);
  EXPECT_EQ(time_to_reach(series, &Measurement::l2, 0.5), 16);  // the coarsest mesh is better
  EXPECT_FALSE(time_to_reach(series, &Measurement::l2, 1. / 257));
}

TEST(Convergence, EachLevelIsThatOfTheFastestSolver) {
  std::vector<Measurement> table = exact_powers("slow", 2);
  for (const Measurement& m : exact_powers("fast")) table.push_back(m);
  table.push_back({"other problem", "method", "fast", 16, 32, 1, 1, 0, 0, 0, 0, 0});
  const std::vector<Series> all = series_of(table, "problem");
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].levels.size(), 3u);
  for (const Measurement& m : all[0].levels) EXPECT_EQ(m.solver, "fast");
}

TEST(MeasurementTable, IsReadAsItWasWritten) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "measurements.csv";
  work_precision::write_table(path, exact_powers("a"));
  const std::vector<Measurement> read = work_precision::read_table(path);
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[1].solver, "a");
  EXPECT_EQ(read[1].n_cells, 64);
  EXPECT_NEAR(read[1].energy, 3. / 8, 1e-4);
  EXPECT_EQ(read[1].total(), 64);
  std::ofstream(path) << "something else\n";
  EXPECT_THROW(work_precision::read_table(path), polyfem::Error);
}

TEST(MarkedPage, FillsItsPlacesAndKeepsTheRest) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "page.md";
  std::ofstream(path) << "by hand\n<!-- a -->\nold\n<!-- end -->\nmore\n<!-- b -->\n<!-- end -->\n";
  MarkedPage page(path);
  page.fill("a", "new\n");
  page.fill("b", markdown({{"x", "y"}, {"1", "2"}}));
  EXPECT_THROW(page.fill("c", ""), polyfem::Error);
  page.write();
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(),
            "by hand\n<!-- a -->\nnew\n<!-- end -->\nmore\n<!-- b -->\n"
            "| x | y |\n|---|---:|\n| 1 | 2 |\n<!-- end -->\n");
}

}  // namespace
