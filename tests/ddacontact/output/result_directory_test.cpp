#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/result_directory.hpp>
#include <ddacontact/output/summary_reader.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

using namespace support;

namespace {

/// A directory of this test alone, removed at its end.
struct Directory {
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      ("ddacontact_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       std::to_string(std::random_device()()));
  ~Directory() { std::filesystem::remove_all(path); }
};

using Row = std::map<std::string, std::string>;

std::vector<Row> read_csv(const std::filesystem::path& path) {
  const CsvTable table(path);
  std::vector<Row> rows(table.n_rows());
  for (const std::string& name : table.header()) {
    const std::vector<std::string> texts = table.texts(name);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k][name] = texts[k];
  }
  return rows;
}

double number(const Row& row, const char* name) {
  return std::stod(row.at(name));
}

/// Two blocks on a held one, away from the origin; the pushed one given clockwise when `clockwise`.
Scene three_blocks(bool clockwise) {
  Scene scene = rock_scene(0.01, 50);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = 30;
  scene.blocks = {block(rectangle(98, 199, 6, 1), true), block(rectangle(100, 200, 2, 1))};
  scene.blocks[0].name = "floor";
  scene.blocks[0].model = clockwise ? BlockModel::affine : BlockModel::wachspress;
  if (clockwise)
    for (BlockDescription& b : scene.blocks) b.vertices = b.vertices.rowwise().reverse().eval();
  scene.loads = {point_load(1, {101, 200.25}, constant({2e3, 0}))};
  scene.monitors = {{"corner", 1, Monitor::Kind::vertex, Vec2(0, 0), 0},
                    {"middle", 1, Monitor::Kind::centroid, Vec2(0, 0), 0}};
  return scene;
}

void write(const Scene& scene, const std::filesystem::path& path) {
  const BuiltScene built = build(scene);
  ResultDirectory results(path, built.labels);
  results.write_step(*built.stepper, built.monitor_targets);
  for (int k = 0; k < scene.analysis.steps; ++k) {
    ASSERT_TRUE(built.stepper->step());
    results.write_step(*built.stepper, built.monitor_targets);
  }
  results.finish(*built.stepper, {});
}

}  // namespace

TEST(CsvFile, WhatCannotBeWrittenIsAnError) {
  EXPECT_THROW(CsvFile("/nowhere/at/all.csv", "a"), OutputError);
  EXPECT_THROW(make_directory("/proc/nothing/can/be/made/here"), OutputError);
}

/// A regular polygon with `nodes` more vertices on each edge, unevenly, and which vertices are its own.
struct Noded {
  Points outline;
  std::vector<int> corners;
  Noded(int n, int nodes) : outline(2, n * (nodes + 1)) {
    const auto corner = [n](int k) -> Vec2 {
      const double angle = 2 * std::numbers::pi * k / n;
      return {std::cos(angle), std::sin(angle)};
    };
    for (int k = 0; k < n; ++k) {
      corners.push_back(k * (nodes + 1));
      for (int i = 0; i <= nodes; ++i)
        outline.col(k * (nodes + 1) + i) =
            corner(k) + std::pow(i / (nodes + 1.), 2) * (corner(k + 1) - corner(k));
    }
  }
};

TEST(OutlineLabels, EdgesRunBetweenTheScenesVerticesInItsDirection) {
  for (bool turned : {false, true})
    for (int nodes : {0, 1, 3})
      for (int n = 3; n < 8; ++n) {
        const Noded polygon(n, nodes);
        const OutlineLabels labels =
            label_outline(static_cast<int>(polygon.outline.cols()), polygon.corners, turned);
        const int n_outline = static_cast<int>(polygon.outline.cols());
        ASSERT_EQ(labels.n_vertices, n);
        // The outline in the scene's direction, from the scene's first vertex on.
        std::vector<int> order;
        const auto first = std::find(labels.vertex.begin(), labels.vertex.end(), 0) - labels.vertex.begin();
        for (int k = 0; k < n_outline; ++k)
          order.push_back(static_cast<int>(first + (turned ? n_outline - k : k)) % n_outline);
        int vertex = 0, node = n;
        Points scene(2, n);
        for (int v : order) {
          const bool is_node = v % (nodes + 1) != 0;
          EXPECT_EQ(labels.vertex[v], is_node ? node++ : vertex++);
          if (!is_node) scene.col(labels.vertex[v]) = polygon.outline.col(v);
        }
        for (int v = 0; v < n_outline; ++v) {
          const int edge = labels.edge[v];
          const Vec2 from = scene.col(edge), to = scene.col((edge + 1) % n);
          const Vec2 middle = (polygon.outline.col(v) + polygon.outline.col((v + 1) % n_outline)) / 2;
          EXPECT_NEAR((middle - from).norm() + (middle - to).norm(), (to - from).norm(), 1e-12);
        }
      }
}

/// What holds a node on an edge is told of the edge's ends, with the same resultant and moment.
TEST(ResultDirectory, ReactionsAtNodesOnEdgesGoToTheScenesVertices) {
  for (bool turned : {false, true}) {
    Scene scene = rock_scene(0.01, 1);
    Points outline(2, 4);
    outline << 0, 0.5, 2, 1,  //
        0, -0.05, 0, 1.5;     // the second nearly on an edge: Wachspress blocks have no other nodes
    scene.blocks = {block(outline, true)};
    BuiltScene built = build(scene);
    run(*built.stepper, 1);
    built.labels.outlines[0] = std::make_shared<OutlineLabels>(label_outline(4, {0, 2, 3}, turned));
    built.labels.block_reasons[0] = "held, so one cell";
    const Directory directory;
    ResultDirectory results(directory.path, built.labels);
    results.finish(*built.stepper, {});

    Points scene_outline(2, 4);
    scene_outline << outline.col(0), outline.col(2), outline.col(3), outline.col(1);
    if (turned) scene_outline.col(0).swap(scene_outline.col(2));
    const Points& expected = built.stepper->reactions();
    Vec2 force = expected.rowwise().sum();
    double moment = 0;
    for (int v = 0; v < 4; ++v) moment += cross(Vec2(outline.col(v)), Vec2(expected.col(v)));
    const double on_node = expected.col(1).norm();
    EXPECT_GT(on_node, 1e3);
    const std::vector<Row> rows = read_csv(directory.path / "supports.csv");
    ASSERT_EQ(rows.size(), 3u);
    for (const Row& row : rows) {
      const Vec2 f(number(row, "fx"), number(row, "fy")), x = scene_outline.col(std::stoi(row.at("vertex")));
      force -= f;
      moment -= cross(x, f);
    }
    EXPECT_LE(force.norm(), 1e-9 * 30e3);
    EXPECT_NEAR(moment, 0, 1e-6 * on_node);

    const std::vector<Row> vertices = read_csv(directory.path / "vertices.csv");
    ASSERT_EQ(vertices.size(), 4u);
    for (int v = 0; v < 4; ++v) {
      EXPECT_EQ(vertices[v].at("vertex"), std::to_string(v));
      EXPECT_NEAR(number(vertices[v], "x"), scene_outline(0, v), 1e-12);
      EXPECT_NEAR(number(vertices[v], "y"), scene_outline(1, v), 1e-12);
    }
    const CsvTable blocks(directory.path / "blocks.csv");
    EXPECT_EQ(blocks.numbers("vertices"), std::vector<double>{3});
    EXPECT_EQ(blocks.numbers("cells"), std::vector<double>{1});
    EXPECT_EQ(blocks.numbers("unknowns"), std::vector<double>{8});
    EXPECT_EQ(blocks.texts("reason"), std::vector<std::string>{"held, so one cell"});
  }
}

/// The files speak of the scene's own coordinates and vertex order, whichever way its outlines run.
TEST(ResultDirectory, ResultsSpeakOfTheScenesVerticesAndCoordinates) {
  for (bool clockwise : {false, true}) {
    const Directory directory;
    const Scene scene = three_blocks(clockwise);
    write(scene, directory.path);

    const auto vertices = read_csv(directory.path / "vertices.csv");
    ASSERT_EQ(vertices.size(), 8u);
    for (const Row& row : vertices) {
      const Points& outline = scene.blocks[row.at("block") == "floor" ? 0 : 1].vertices;
      const Vec2 start = outline.col(std::stoi(row.at("vertex")));
      EXPECT_NEAR(number(row, "x") - number(row, "ux"), start.x(), 1e-12);
      EXPECT_NEAR(number(row, "y") - number(row, "uy"), start.y(), 1e-12);
      EXPECT_LT(std::hypot(number(row, "ux"), number(row, "uy")), 0.01);
    }

    Vec2 on_slider = Vec2::Zero();
    const auto contacts = read_csv(directory.path / "contacts.csv");
    ASSERT_EQ(contacts.size(), 2u);
    for (const Row& row : contacts) {
      EXPECT_EQ(row.at("block_a"), "1");
      EXPECT_EQ(row.at("block_b"), "floor");
      EXPECT_EQ(row.at("state"), "stick");
      const Points &a = scene.blocks[1].vertices, &b = scene.blocks[0].vertices;
      const int edge = std::stoi(row.at("edge"));
      const Vec2 vertex = a.col(std::stoi(row.at("vertex"))), j = b.col(edge), k = b.col((edge + 1) % 4);
      EXPECT_EQ(vertex.y(), 200);
      EXPECT_TRUE(j.y() == 200 && k.y() == 200);
      on_slider +=
          number(row, "normal_force") * Vec2(0, 1) + number(row, "shear_force") * (k - j).normalized();
    }
    EXPECT_LE((on_slider - Vec2(-2e3, 40e3)).norm(), 1e-3 * 40e3);

    Vec2 reaction = Vec2::Zero();
    const auto supports = read_csv(directory.path / "supports.csv");
    EXPECT_EQ(supports.size(), 4u);
    for (const Row& row : supports) reaction += Vec2(number(row, "fx"), number(row, "fy"));
    EXPECT_LE((reaction - Vec2(-2e3, 160e3)).norm(), 1e-6 * 160e3);

    const auto blocks = read_csv(directory.path / "blocks.csv");
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_NEAR(number(blocks[1], "x"), 101, 1e-3);
    EXPECT_NEAR(number(blocks[1], "y"), 200.5, 1e-3);
    EXPECT_NEAR(number(blocks[1], "area_ratio"), 1, 1e-3);
    EXPECT_NEAR(number(blocks[1], "syy_mean"), -10e3, 0.05 * 10e3);
    EXPECT_LE(number(blocks[1], "syy_min"), number(blocks[1], "syy_mean"));
    EXPECT_GE(number(blocks[1], "s1_max"), number(blocks[1], "sxx_mean"));

    const auto monitors = read_csv(directory.path / "monitors.csv");
    EXPECT_EQ(monitors.size(), 2u * 51);
    EXPECT_EQ(number(monitors[0], "x"), scene.blocks[1].vertices(0, 0));
    EXPECT_EQ(number(monitors[1], "y"), 200.5);
    EXPECT_EQ(monitors.back().at("step"), "50");
    EXPECT_EQ(read_csv(directory.path / "energy.csv").size(), 51u);
    EXPECT_TRUE(std::filesystem::exists(directory.path / "summary.json"));
  }
}

/// What `run` counted is what the file says, under the keys of the documentation.
TEST(ResultDirectory, TheSummaryHoldsTheStepsCounts) {
  Scene scene = default_mechanics(rock_scene(0.01, 60));
  scene.joints[0].restitution = 0.5;
  scene.joints[0].friction_angle = 30;
  scene.blocks = {block(rectangle(0, -1, 6, 1), true), block(rectangle(2, 0.05, 1, 1))};
  scene.blocks[1].velocity = {0.3, -2};
  const BuiltScene built = build(scene);
  const Directory directory;
  ResultDirectory results(directory.path, built.labels);
  run(*built.stepper, scene.analysis.steps);
  results.finish(*built.stepper, {});

  const SummaryTable summary = read_summary(directory.path / "summary.json");
  const StepCounts& counts = built.stepper->counts();
  const std::pair<const char*, long> expected[] = {{"substeps", counts.substeps},
                                                   {"interior_paths", counts.interior_point_solves},
                                                   {"augmentations", counts.augmentations},
                                                   {"broken_bonds", counts.broken_bonds},
                                                   {"impacts", counts.impacts},
                                                   {"limited_impacts", counts.limited_impacts},
                                                   {"unsettled_impacts", counts.unsettled_impacts},
                                                   {"overlap_rejections", counts.overlap_rejections},
                                                   {"unknown_velocities", counts.unknown_velocities}};
  for (const auto& [key, count] : expected) EXPECT_EQ(summary.number(key), count) << key;
  EXPECT_EQ(summary.number("max_residual"), counts.max_residual);
  EXPECT_GT(counts.impacts, 0);
  EXPECT_GT(counts.augmentations, 0);
  EXPECT_LE(counts.max_residual, 1e-8);
}

TEST(StressRange, IsTheAverageAndTheExtremesOverTheIntegrationPoints) {
  Scene scene = rock_scene(0.01, 1);
  scene.blocks = {block(rectangle(0, 0, 2, 1))};
  const BuiltScene built = build(scene);
  const Block& of = built.stepper->blocks().block(0);
  BlockState state = built.stepper->state();
  state.stress.colwise() = Vec3(3, -5, 0);
  StressRange uniform = stress_range(of, state);
  for (const Vec3& s : {uniform.mean, uniform.min, uniform.max})
    EXPECT_LE((s - Vec3(3, -5, 0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(uniform.s1_max, 3);
  EXPECT_DOUBLE_EQ(uniform.s2_min, -5);
  state.stress.col(0) = Vec3(0, 0, 10);
  const StressRange range = stress_range(of, state);
  EXPECT_LE((range.max - Vec3(3, 0, 10)).norm(), 1e-12);
  EXPECT_LE((range.min - Vec3(0, -5, 0)).norm(), 1e-12);
  EXPECT_NEAR(range.mean[2], 10 * of.integration_weights()[0] / 2, 1e-9);
  EXPECT_NEAR(range.s1_max, 10, 1e-12);
  EXPECT_NEAR(range.s2_min, -10, 1e-12);
}

/// A divided block is held at points that the scene does not know, inside it and on its edges.
TEST(ResultDirectory, ADividedBlockWeighsOnItsVertices) {
  for (bool clockwise : {false, true}) {
    Scene scene = default_mechanics(rock_scene(0.01, 1));
    Points l_shape(2, 6);
    l_shape << 0, 3, 3, 1, 1, 0,  //
        0, 0, 1, 1, 2, 2;
    if (clockwise) l_shape = l_shape.rowwise().reverse().eval();
    scene.blocks = {block(l_shape, true)};
    scene.blocks[0].model = BlockModel::mesh;
    scene.blocks[0].mesh.cells = 20;
    const BuiltScene built = build(scene);
    run(*built.stepper, 1);
    const Directory directory;
    ResultDirectory results(directory.path, built.labels);
    results.finish(*built.stepper, {});
    const std::vector<Row> rows = read_csv(directory.path / "supports.csv");
    ASSERT_EQ(rows.size(), 6u);
    const double weight = 4 * 2000 * 10, lever = (3 * 1.5 + 1 * 0.5) / 4;
    double force = 0, moment = 0;
    for (int v = 0; v < 6; ++v) {
      force += number(rows[v], "fy");
      moment += l_shape(0, v) * number(rows[v], "fy") - l_shape(1, v) * number(rows[v], "fx");
    }
    EXPECT_NEAR(force, weight, 1e-9 * weight);
    EXPECT_NEAR(moment, lever * weight, 1e-9 * weight);

    const CsvTable blocks(directory.path / "blocks.csv"), vertices(directory.path / "vertices.csv");
    const Block& divided = built.stepper->blocks().block(0);
    EXPECT_EQ(blocks.numbers("vertices"), std::vector<double>{6});
    EXPECT_EQ(blocks.numbers("cells"), std::vector<double>{static_cast<double>(divided.n_cells())});
    EXPECT_EQ(blocks.numbers("unknowns"), std::vector<double>{static_cast<double>(divided.n_unknowns())});
    ASSERT_EQ(vertices.n_rows(), static_cast<std::size_t>(divided.n_vertices()));
    ASSERT_GT(vertices.n_rows(), 6u);
    for (int v = 0; v < 6; ++v) {
      EXPECT_NEAR(vertices.numbers("x")[v], l_shape(0, v), 1e-9);
      EXPECT_NEAR(vertices.numbers("y")[v], l_shape(1, v), 1e-9);
    }
  }
}
