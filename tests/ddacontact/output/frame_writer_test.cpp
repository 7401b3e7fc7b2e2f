#include <ddacontact/output/cell_view.hpp>
#include <ddacontact/output/frame_reader.hpp>
#include <ddacontact/output/frame_writer.hpp>
#include <ddacontact/output/output_error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>

using namespace support;

namespace {

class FrameWriterTest : public testing::Test {
 protected:
  FrameWriterTest() { std::filesystem::create_directories(directory); }
  ~FrameWriterTest() override { std::filesystem::remove_all(directory); }

  static Scene falling_block() {
    Scene scene = rock_scene(0.01, 10);
    scene.blocks = {block(rectangle(0, 0, 2, 1))};
    return scene;
  }
  /// Runs `steps` steps as the program does.
  void write(int steps, const FrameOptions& options) {
    const BuiltScene built = build(falling_block());
    FrameWriter frames(directory, options);
    frames.write_step(*built.stepper, built.labels);
    for (int k = 0; k < steps; ++k) {
      run(*built.stepper, 1);
      frames.write_step(*built.stepper, built.labels);
    }
    frames.write_last(*built.stepper, built.labels);
  }
  std::vector<long> steps() const {
    std::vector<long> result;
    for (const FrameFile& file : read_series(directory)) result.push_back(file.step);
    return result;
  }
  std::set<std::filesystem::path> files_there() const {
    std::set<std::filesystem::path> result;
    for (const auto& entry : std::filesystem::directory_iterator(directory / "frames"))
      result.insert(entry.path());
    return result;
  }

  std::filesystem::path directory = std::filesystem::path(testing::TempDir()) /
                                    ("frame_writer_test" + std::to_string(std::random_device()()));
};

TEST_F(FrameWriterTest, WhatIsComputedThoughNotAskedForIsNotWritten) {
  const auto files = [&] {
    std::map<std::string, std::string> bytes;
    for (const auto& file : std::filesystem::recursive_directory_iterator(directory)) {
      std::ifstream in(file.path(), std::ios::binary);
      if (file.is_regular_file()) bytes[file.path().string()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return bytes;
  };
  FrameOptions options{.every = 2, .velocity = false, .stress = false, .principal = false};
  write(5, options);
  const auto skipped = files();
  options.skip = false;
  write(5, options);
  EXPECT_EQ(files(), skipped);
}

TEST_F(FrameWriterTest, EveryKStepsFromTheStartAndAlwaysTheLast) {
  write(6, {.every = 1});
  EXPECT_EQ(steps(), (std::vector<long>{0, 1, 2, 3, 4, 5, 6}));
  write(6, {.every = 3});
  EXPECT_EQ(steps(), (std::vector<long>{0, 3, 6}));
  write(6, {.every = 4});
  EXPECT_EQ(steps(), (std::vector<long>{0, 4, 6}));
  write(6, {.every = 0});
  EXPECT_EQ(steps(), std::vector<long>{6});
  write(0, {.every = 0});
  EXPECT_EQ(steps(), std::vector<long>{0});
}

TEST_F(FrameWriterTest, SeriesListExactlyTheFilesThere) {
  for (int every : {1, 3, 0}) {
    write(6, {.every = every});  // fewer each time: nothing of the run before may stay
    std::set<std::filesystem::path> listed;
    for (const FrameFile& file : read_series(directory)) listed.insert({file.blocks, file.contacts});
    EXPECT_EQ(listed, files_there());
  }
}

TEST_F(FrameWriterTest, FilesThatAreNotOursStay) {
  std::filesystem::create_directories(directory / "frames");
  const auto mine = directory / "frames" / "my_blocks.vtu";
  std::ofstream(mine) << "mine";
  write(1, {});
  EXPECT_TRUE(std::filesystem::exists(mine));
}

TEST_F(FrameWriterTest, FramesHoldTheRunsStates) {
  const BuiltScene built = build(falling_block());
  FrameWriter frames(directory, {.refine = 2});
  frames.write_step(*built.stepper, built.labels);
  run(*built.stepper, 1);
  frames.write_step(*built.stepper, built.labels);
  const FrameSeries series = read_series(directory);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[1].time, built.stepper->state().time);
  const Frame start = read_frame(series[0]), end = read_frame(series[1]);
  EXPECT_EQ(end.step, 1);
  EXPECT_EQ(end.time, built.stepper->state().time);
  EXPECT_EQ(start.position, rectangle(0, 0, 2, 1));
  EXPECT_LE((end.displacement - (end.position - start.position)).norm(), 1e-15);
  EXPECT_LE((end.velocity.colwise() - Vec2(0, -0.1)).norm(), 1e-10);  // falls freely, 10 m/s2
}

TEST_F(FrameWriterTest, FramesHoldHowFarBlocksHaveTurned) {
  Scene scene = falling_block();
  scene.blocks[0].angular_velocity = 3;
  const BuiltScene built = build(scene);
  FrameWriter frames(directory, {});
  run(*built.stepper, 4);
  frames.write_last(*built.stepper, built.labels);
  const double rotation = read_frame(read_series(directory)[0]).block_values.at("rotation")[0];
  EXPECT_EQ(rotation, built.stepper->state().rotation[0]);
  EXPECT_NEAR(rotation, 4 * 0.01 * 3, 0.002 * rotation);  // it swells
}

/// What a divided block stores at its integration points is what its frame tells of its cells.
TEST_F(FrameWriterTest, CellsOfADividedBlockHoldItsStress) {
  Scene scene = default_mechanics(rock_scene(0.01, 5));
  scene.blocks = {block(turned(rectangle(0, 0, 2, 1), 0.3))};
  scene.blocks[0].fixed_vertices = {0, 3};
  scene.blocks[0].model = BlockModel::mesh;
  scene.blocks[0].mesh.cells = 12;
  const BuiltScene built = support::run(scene);
  FrameWriter frames(directory, {});
  frames.write_last(*built.stepper, built.labels);
  const Frame frame = read_frame(read_series(directory)[0]);
  ASSERT_GT(frame.n_cells(), 5);
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (int c = 0; c < frame.n_cells(); ++c) {
    const CellView view(frame, c);
    const double of_cell = polyfem::signed_area(view.corners());
    sum += of_cell * view.mean_stress();
    area += of_cell;
  }
  EXPECT_NEAR(area, polyfem::signed_area(frame.outline(0)), 1e-12);
  const Vec3 mean = frame.mean_stress.col(0);
  EXPECT_GT(mean.norm(), 1e3);
  EXPECT_LE((sum / area - mean).norm(), 1e-2 * mean.norm());
}

TEST_F(FrameWriterTest, TheLastStateIsWrittenOnce) {
  const BuiltScene built = build(falling_block()), later = run(falling_block());
  FrameWriter frames(directory, {});
  frames.write_step(*built.stepper, built.labels);
  frames.write_last(*built.stepper, built.labels);
  EXPECT_EQ(steps(), std::vector<long>{0});
  frames.write_last(*later.stepper, later.labels);
  EXPECT_EQ(steps(), (std::vector<long>{0, 10}));
}

TEST_F(FrameWriterTest, WhatIsMissingFromADirectoryIsNamed) {
  const auto expect_message = [&](const char* word) {
    try {
      read_series(directory);
      ADD_FAILURE() << word;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expect_message("results.pvd");
  write(1, {});
  std::filesystem::remove(directory / "contacts.pvd");
  expect_message("contacts.pvd");
  { FrameWriter(directory, {}); }
  expect_message("no frames");
  std::filesystem::remove_all(directory);
  expect_message("no directory");
}

TEST_F(FrameWriterTest, FramesThatCannotBeWrittenAreErrorsAndNotListed) {
  EXPECT_THROW(FrameWriter("/nowhere/at/all", {}), OutputError);
  const BuiltScene built = build(falling_block());
  FrameWriter frames(directory, {});
  frames.write_step(*built.stepper, built.labels);
  std::filesystem::remove_all(directory / "frames");
  run(*built.stepper, 1);
  EXPECT_THROW(frames.write_step(*built.stepper, built.labels), OutputError);
  EXPECT_EQ(steps(), std::vector<long>{0});
}

}  // namespace
