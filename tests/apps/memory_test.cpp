// Scenes that do not fit into memory are refused before anything is built, by an estimate that is near to
// what runs take.
#include "program.hpp"

#include <ddacontact/scene/memory_estimate.hpp>
#include <ddacontact/scene/reader.hpp>

#include <algorithm>

namespace {

using namespace support;

/// A brick wall in running bond on a fixed block.
std::string wall(int rows, int columns, const std::string& model,
                 const std::string& analysis = "time_step = 0.001") {
  std::ostringstream text;
  text << "[analysis]\n"
       << analysis << "\nsteps = 1\nblock_model = \"" << model
       << "\"\nmesh = { cells = 12 }\n[[material]]\nname = \"rock\"\ndensity = 2500\nyoung = \"10 GPa\"\n"
          "poisson = 0.2\n[[joint]]\nfriction_angle = 35\n[output]\nevery = 0\n";
  const auto add = [&](double x, double y, double x_end, double y_end, const char* keys) {
    text << "[[block]]\nmaterial = \"rock\"\n"
         << keys << "vertices = [[" << x << ", " << y << "], [" << x_end << ", " << y << "], [" << x_end
         << ", " << y_end << "], [" << x << ", " << y_end << "]]\n";
  };
  add(-1, -1, columns + 1, 0, "fixed = true\nmodel = \"affine\"\n");
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns; ++k) {
      const double x = k + 0.5 * (row % 2);
      add(x, 0.5 * row, x + 1, 0.5 * row + 0.5, "");
    }
  return text.str();
}

class Memory : public Program {
 protected:
#ifdef __SANITIZE_ADDRESS__
  void SetUp() override {
    GTEST_SKIP() << "under a sanitizer memory is not the program's own";
  }
#endif
  /// Calls the program with so many kB of address space; a call that hangs is ended, with the status 124.
  int dda_within(int kilobytes, const std::string& arguments) {
    std::ofstream(directory_ / "limited.sh")
        << "ulimit -v " << kilobytes << "\nexec timeout 60 '" << POLYDDA_PROGRAM << "' \"$@\"\n";
    const std::string command = "cd '" + directory_.string() + "' && sh limited.sh " + arguments +
                                " > out.txt 2> err.txt < /dev/null";
    const int status = std::system(command.c_str());
    err_ = read_file(directory_ / "err.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(Memory, IsEstimatedNearToWhatARunTakes) {
  const auto expect_near = [&](const std::string& model, const std::string& analysis) {
    write("wall.toml", model == "mesh" ? wall(6, 10, model, analysis) : wall(40, 60, model, analysis));
    const auto reading = ddacontact::read_scene((directory_ / "wall.toml").string());
    ASSERT_TRUE(reading.scene);
    ASSERT_EQ(dda("run wall.toml -o result --quiet"), 0) << err_;
    const double taken = 1048576 * summary("result")["peak_memory_mb"].get<double>();
    const double estimate = ddacontact::estimate_memory(*reading.scene).total();
    EXPECT_LT(estimate, 1.5 * taken) << model << " " << analysis;
    EXPECT_LT(taken, 1.5 * estimate) << model << " " << analysis;
  };
  for (const char* model : {"wachspress", "affine", "mesh"}) expect_near(model, "time_step = 0.001");
  expect_near("wachspress", "time_step = 0.00001");
}

TEST_F(Memory, IsCountedForAFactorOnlyWhereOneMayBeMade) {
  const auto has_factor = [&](const std::string& model, const std::string& analysis) {
    write("wall.toml", wall(2, 3, model, analysis));
    const auto reading = ddacontact::read_scene((directory_ / "wall.toml").string());
    EXPECT_TRUE(reading.scene) << analysis;
    const ddacontact::MemoryEstimate estimate = ddacontact::estimate_memory(*reading.scene);
    EXPECT_EQ(estimate.factor > 0, estimate.has_factor);
    return estimate.has_factor;
  };
  // A wave crosses bricks of 0.7 m in 0.34 ms.
  const std::string small = "time_step = 0.0003";
  EXPECT_FALSE(has_factor("wachspress", small));
  EXPECT_FALSE(has_factor("affine", small));
  EXPECT_TRUE(has_factor("wachspress", "time_step = 0.0004"));
  EXPECT_TRUE(has_factor("mesh", small));
  EXPECT_FALSE(has_factor("auto", small)) << "squat blocks in motion stay polygons";
  EXPECT_TRUE(has_factor("auto", small + "\nmode = \"static\""));
  EXPECT_TRUE(has_factor("wachspress", small + "\nmode = \"static\""));
}

TEST_F(Memory, ThatDoesNotSufficeIsToldBeforeAnythingIsWritten) {
  write("wall.toml", wall(80, 100, "wachspress"));
  for (const std::string verb : {"run", "check"}) {
    EXPECT_EQ(dda_within(300'000, verb + " wall.toml"), 2) << err_;
    EXPECT_EQ(err_.rfind("wall.toml:1:1: error: 8001 blocks with ", 0), 0u) << err_;
    for (const char* words : {" of memory, ", " of it for the factor of their equations; ",
                              " are available (about ", " blocks like these would fit)"})
      EXPECT_NE(err_.find(words), std::string::npos) << words << " in " << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
  }
  EXPECT_FALSE(fs::exists(directory_ / "wall-out"));
}

TEST_F(Memory, ThatIsShortSufficesForAFewBlocks) {
  write("wall.toml", wall(2, 3, "wachspress"));
  for (const std::string verb : {"check", "run"})
    EXPECT_EQ(dda_within(200'000, verb + " wall.toml"), 0) << err_;
}

TEST_F(Memory, ThatTheBlasLacksEndsARun) {
  write("wall.toml", wall(30, 40, "wachspress"));
  const int status = dda_within(190'000, "run wall.toml");
  if (status == 0) GTEST_SKIP() << "this BLAS takes no such buffer";
  EXPECT_EQ(status, 3) << err_;
  EXPECT_NE(err_.find("not enough memory for the 128 MB that OpenBLAS works in"), std::string::npos) << err_;
}

TEST_F(Memory, ForTooManyCellsIsRefused) {
  EXPECT_EQ(dda_within(1'000'000, "make voronoi --cells 5000000 -o cells.wkt"), 2);
  EXPECT_NE(err_.find("5000000 cells take about"), std::string::npos) << err_;
}

}  // namespace
