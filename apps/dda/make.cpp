#include "make.hpp"

#include "exit_status.hpp"
#include "messages.hpp"
#include "option_values.hpp"
#include "plain_help.hpp"

#include <fmt/format.h>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/whole_file.hpp>
#include <ddacontact/scene/available_memory.hpp>
#include <ddacontact/scene/geometry_writer.hpp>
#include <ddacontact/scene/memory_estimate.hpp>
#include <ddacontact/scene/reader.hpp>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

namespace dda {

namespace {

using polyfem::Error;
using polyfem::Index;
using polyfem::Points;
using polyfem::Vec2;

/// Of a Voronoi mesh and the file made of it, as measured.
constexpr double bytes_of_cell = 2000;

/// "x,y" as a point.
Vec2 point_of(const std::string& word) {
  Vec2 point;
  const char* const end = word.data() + word.size();
  const auto x = std::from_chars(word.data(), end, point.x());
  if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, end, point.y());
    if (y.ec == std::errc() && y.ptr == end) return point;
  }
  throw Error(fmt::format("\"{}\" of --domain is not a point (write \"x,y x,y ...\")", word));
}

Points domain_of(const MakeArguments& arguments) {
  std::vector<Vec2> points;
  if (arguments.domain.empty()) {
    const double width = arguments.box[0], height = arguments.box[1];
    if (!(width > 0 && height > 0)) throw Error("--box needs a width and a height above 0");
    points = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  } else {
    std::istringstream words(arguments.domain);
    for (std::string word; words >> word;) points.push_back(point_of(word));
  }
  Points domain(2, static_cast<Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) domain.col(static_cast<Index>(k)) = points[k];
  return domain;
}

void make_voronoi(const MakeArguments& arguments) {
  ddacontact::geometry_format(arguments.file);  // an unknown ending is an error before anything is computed
  const double needed = bytes_of_cell * arguments.voronoi.n_cells;
  if (const auto available = ddacontact::available_memory(); available && *available < needed)
    throw Error(fmt::format("{} cells take about {} of memory, {} are available (about {:.2g} would fit)",
                            arguments.voronoi.n_cells, ddacontact::bytes_text(needed),
                            ddacontact::bytes_text(*available), *available / bytes_of_cell));
  const polyfem::PolygonMesh mesh = polyfem::voronoi(domain_of(arguments), arguments.voronoi);
  std::vector<Points> blocks;
  blocks.reserve(mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) blocks.push_back(mesh.outline(c));
  tell_of_older(arguments.file, ddacontact::write_geometry(arguments.file, blocks,
                                                           fmt::format("{} Voronoi blocks", blocks.size())));
  fmt::print("{}: {} Voronoi blocks, seed {}\n", arguments.file, blocks.size(), arguments.voronoi.seed);
}

std::string scene_of(const MakeArguments& arguments) {
  if (arguments.kind == "joints") return ddacontact::made_scene(arguments.slope);
  if (arguments.kind == "tunnel") return ddacontact::made_scene(arguments.tunnel);
  if (arguments.kind == "wall") return ddacontact::made_scene(arguments.wall);
  if (arguments.kind == "arch") return ddacontact::made_scene(arguments.arch);
  if (arguments.kind == "column") return ddacontact::made_scene(arguments.column);
  return ddacontact::made_scene(arguments.heap);
}

/// The scene itself to .toml, its blocks to other files.
void make_scene(const MakeArguments& arguments) {
  const ddacontact::GeometryFormat format = ddacontact::geometry_format(arguments.file);
  const std::string text = scene_of(arguments);
  const ddacontact::SceneReading reading = ddacontact::read_scene_text(text, arguments.file);
  if (!reading.scene) {
    const auto error = std::ranges::find(reading.problems, ddacontact::Problem::Severity::error,
                                         &ddacontact::Problem::severity);
    throw Error(fmt::format("{} (choose other measures)", error->text()));
  }
  tell_of_older(arguments.file, format == ddacontact::GeometryFormat::toml
                                    ? ddacontact::write_and_keep_older(arguments.file, text)
                                    : ddacontact::write_blocks(arguments.file, *reading.scene, 0));
  fmt::print("{}: {} blocks\n", arguments.file, reading.scene->blocks.size());
}

/// Adds a kind of scene with the option of its file.
CLI::App* add_kind(CLI::App& make, MakeArguments& arguments, const char* kind, const char* what) {
  CLI::App* app = make.add_subcommand(kind, what);
  app->add_option("-o,--output", arguments.file,
                  "File to write: .toml (a scene to run), .geojson, .wkt or .dxf")
      ->required()
      ->type_name("FILE");
  app->callback([&arguments, kind] { arguments.kind = kind; });
  return app;
}

void add_length(CLI::App* app, const char* name, double& value, const char* what) {
  expect_number(app->add_option(name, value), 1e-6, 1e6)
      ->description(what)  // without the bounds, which nobody needs to know in advance
      ->capture_default_str();
}

void add_count(CLI::App* app, const char* name, int& value, int least, const char* what) {
  expect_whole_number(app->add_option(name, value, what), least, 1000000)->capture_default_str();
}

void add_seed(CLI::App* app, int& seed) {
  add_count(app, "--seed", seed, 0, "The same seed gives the same blocks");
}

void add_rock(CLI::App& make, MakeArguments& arguments) {
  ddacontact::MadeSlope& slope = arguments.slope;
  CLI::App* app = add_kind(make, arguments, "joints", "A rock slope with two joint sets");
  add_length(app, "--height", slope.height, "Of the face, m");
  expect_number(app->add_option("--face", slope.face, "Angle of the face, degrees"), 27, 90)
      ->capture_default_str();
  expect_number(app->add_option("--dip", slope.dip, "Of the bedding, out of the face, degrees"), -89, 89)
      ->capture_default_str();
  add_length(app, "--spacing", slope.spacing, "Of the joints, m");
  add_seed(app, slope.seed);

  ddacontact::MadeTunnel& tunnel = arguments.tunnel;
  app = add_kind(make, arguments, "tunnel", "A tunnel in rock with two joint sets");
  add_length(app, "--width", tunnel.width, "Of the tunnel, m");
  add_length(app, "--height", tunnel.height, "From floor to crown, at least half the width, m");
  add_length(app, "--spacing", tunnel.spacing, "Of the joints, m");
  add_seed(app, tunnel.seed);

  app = add_kind(make, arguments, "heap", "Irregular blocks that fall into a bin");
  add_length(app, "--size", arguments.heap.size, "Of a block, m");
  add_count(app, "--blocks", arguments.heap.blocks, 1, "Number of blocks");
  add_seed(app, arguments.heap.seed);
}

void add_masonry(CLI::App& make, MakeArguments& arguments) {
  ddacontact::MadeWall& wall = arguments.wall;
  CLI::App* app = add_kind(make, arguments, "wall", "A wall of bricks with a door under a lintel");
  add_length(app, "--length", wall.length, "m");
  add_length(app, "--height", wall.height, "m");
  add_length(app, "--brick-length", wall.brick_length, "m");
  add_length(app, "--brick-height", wall.brick_height, "m");
  expect_number(app->add_option("--door-width", wall.door_width), 0, 1e6)
      ->description("m; 0: no door")
      ->capture_default_str();
  add_length(app, "--door-height", wall.door_height, "m");
  app->add_flag_callback(
      "--stack", [&wall] { wall.running_bond = false; }, "Stack bond instead of running bond");

  ddacontact::MadeArch& arch = arguments.arch;
  app = add_kind(make, arguments, "arch", "A semicircular arch between springers");
  add_length(app, "--span", arch.span, "Between the springers, m");
  add_length(app, "--thickness", arch.thickness, "m");
  add_count(app, "--voussoirs", arch.voussoirs, 3, "Number of voussoirs");
  app->add_flag("--fill", arch.fill, "With soil above it, between abutments");

  app = add_kind(make, arguments, "column", "A column of drums");
  add_length(app, "--diameter", arguments.column.diameter, "m");
  add_length(app, "--drum", arguments.column.drum, "Height of a drum, m");
  add_count(app, "--drums", arguments.column.drums, 1, "Number of drums");
}

void add_voronoi(CLI::App& make, MakeArguments& arguments) {
  CLI::App* app = add_kind(make, arguments, "voronoi", "Convex blocks of random, evenly spread sites");
  CLI::Option* box = app->add_option("--box", arguments.box)->expected(2)->default_str("20 10");
  expect_positive_number(box)->type_name("WIDTH HEIGHT")->description("Of the domain, m");
  app->add_option("--domain", arguments.domain, "Corners of the domain instead, m, in quotes")
      ->excludes(box)
      ->type_name("\"X,Y X,Y ...\"");
  polyfem::VoronoiOptions& options = arguments.voronoi;
  expect_whole_number(
      app->add_option("--cells", options.n_cells, "Number of blocks; a concave domain gets a few more"), 1,
      10'000'000)
      ->capture_default_str();
  expect_whole_number(app->add_option("--seed", options.seed, "The same seed gives the same blocks"), 0,
                      std::numeric_limits<std::int64_t>::max())
      ->capture_default_str();
  expect_whole_number(app->add_option("--lloyd", options.lloyd_steps, "Steps that make the blocks more even"),
                      0)
      ->capture_default_str();
  expect_number(
      app->add_option("--smallest-edge", options.smallest_edge,
                      "Collapse shorter edges; relative to the size of a block, sqrt(area / cells)"),
      0, 0.3)
      ->capture_default_str();
}

}  // namespace

void add_make(CLI::App& app, MakeArguments& arguments) {
  CLI::App* make = app.add_subcommand("make", "Write scenes to start from, or block geometry");
  make->formatter(plain_help("KIND"));
  make->require_subcommand(1);
  add_rock(*make, arguments);
  add_masonry(*make, arguments);
  add_voronoi(*make, arguments);
  for (CLI::App* kind : make->get_subcommands({})) kind->group("Kinds");
}

int make(const MakeArguments& arguments) {
  try {
    arguments.kind == "voronoi" ? make_voronoi(arguments) : make_scene(arguments);
    return done;
  } catch (const ddacontact::OutputError& error) {
    print_error(error.what());
    return file_error;
  } catch (const Error& error) {
    print_error(error.what());
    return wrong_input;
  }
}

}  // namespace dda
