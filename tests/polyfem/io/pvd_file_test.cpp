#include <gtest/gtest.h>
#include <polyfem/core/error.hpp>
#include <polyfem/io/pvd_file.hpp>

#include <sys/resource.h>

#include <csignal>
#include <random>

using namespace polyfem;

namespace {

class PvdFileTest : public testing::Test {
 protected:
  ~PvdFileTest() override { std::filesystem::remove(path); }
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("pvd_file_test" + std::to_string(std::random_device()()));
};

TEST_F(PvdFileTest, SeriesIsWholeAfterEachEntry) {
  PvdFile series(path);
  EXPECT_TRUE(read_pvd(path).empty());
  for (int k = 0; k < 20; ++k) {
    const double time = 0.1 * k + 1e-17 * k;
    series.add({time, 3 * k, "frames/" + std::to_string(k) + ".vtu"});
    const std::vector<PvdEntry> entries = read_pvd(path);
    ASSERT_EQ(entries.size(), static_cast<std::size_t>(k + 1));
    EXPECT_EQ(entries.back().time, time);
    EXPECT_EQ(entries.back().step, 3 * k);
    EXPECT_EQ(entries.back().file, "frames/" + std::to_string(k) + ".vtu");
    EXPECT_EQ(entries.front().time, 0);
  }
}

TEST_F(PvdFileTest, ANewSeriesTakesThePlaceOfAnOldOne) {
  PvdFile(path).add({1, 1, "old.vtu"});
  PvdFile series(path);
  EXPECT_TRUE(read_pvd(path).empty());
}

/// A limit on the size of files stands for a full disk: the write gets only so far.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(PvdFileTest, OnAFullDiskTheSeriesStaysAsItWas) {
  PvdFile series(path);
  series.add({1, 1, "a.vtu"});
  const auto size = std::filesystem::file_size(path);
  for (const rlim_t more : {0, 1, 20, 40}) {
    {
      const FileSizeLimit limit(size + more);
      EXPECT_THROW(series.add({2, 2, "b.vtu"}), FileError);
    }
    EXPECT_EQ(read_pvd(path).size(), 1u) << more;
    EXPECT_EQ(std::filesystem::file_size(path), size);
  }
  series.add({2, 2, "c.vtu"});
  EXPECT_EQ(read_pvd(path).back().file, "c.vtu");
}

TEST_F(PvdFileTest, DamageIsAnErrorThatNamesTheFile) {
  EXPECT_THROW(PvdFile("/nowhere/at/all.pvd"), FileError);
  for (const char* text :
       {"", "<VTKFile>", "no xml", "<VTKFile/>",
        "<VTKFile><Collection><DataSet timestep='x' step='1' file='a'/></Collection></VTKFile>",
        "<VTKFile><Collection><DataSet timestep='1' file='a'/></Collection></VTKFile>"}) {
    std::ofstream(path, std::ios::binary) << text;
    try {
      read_pvd(path);
      ADD_FAILURE() << text;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

}  // namespace
