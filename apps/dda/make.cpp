#include "make.hpp"

#include "exit_status.hpp"
#include "memory.hpp"
#include "messages.hpp"

#include <fmt/format.h>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/scene/geometry_writer.hpp>

#include <charconv>
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

/// For whole numbers without a sign, which the conversion would wrap around.
std::string not_negative(const std::string& word) {
  return word.starts_with('-') ? fmt::format("\"{}\" is negative", word) : std::string();
}

void make_voronoi(const MakeArguments& arguments) {
  ddacontact::geometry_format(arguments.file);  // an unknown ending is an error before anything is computed
  const double needed = bytes_of_cell * arguments.voronoi.n_cells;
  if (const auto available = available_memory(); available && *available < needed)
    throw Error(fmt::format("{} cells take about {} of memory, {} are available (about {:.2g} would fit)",
                            arguments.voronoi.n_cells, bytes_text(needed), bytes_text(*available),
                            *available / bytes_of_cell));
  const polyfem::PolygonMesh mesh = polyfem::voronoi(domain_of(arguments), arguments.voronoi);
  std::vector<Points> blocks;
  blocks.reserve(mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) blocks.push_back(mesh.outline(c));
  ddacontact::write_geometry(arguments.file, blocks, fmt::format("{} Voronoi blocks", blocks.size()));
  fmt::print("{}: {} Voronoi blocks, seed {}\n", arguments.file, blocks.size(), arguments.voronoi.seed);
}

}  // namespace

std::string problem_of_kind(const std::string& kind) {
  if (kind == "voronoi" || kind.starts_with('-')) return {};
  if (kind.empty()) return "make needs a KIND (known: voronoi)";
  if (kind == "joints" || kind == "wall" || kind == "arch")
    return fmt::format("make \"{}\" is not available in this version (known: voronoi)", kind);
  return fmt::format("unknown KIND \"{}\" (known: voronoi)", kind);
}

void add_make(CLI::App& app, MakeArguments& arguments) {
  CLI::App* make = app.add_subcommand("make", "Write block geometry");
  make->require_subcommand(1);
  CLI::App* voronoi = make->add_subcommand("voronoi", "Convex blocks of random, evenly spread sites");
  voronoi
      ->add_option("-o,--output", arguments.file, "File to write: .geojson, .wkt or .toml (a scene to run)")
      ->required();
  CLI::Option* box = voronoi->add_option("--box", arguments.box, "Width and height of the domain, m")
                         ->expected(2)
                         ->capture_default_str();
  voronoi->add_option("--domain", arguments.domain, "\"x,y x,y ...\": corners of the domain instead, m")
      ->excludes(box);
  polyfem::VoronoiOptions& options = arguments.voronoi;
  voronoi->add_option("--cells", options.n_cells, "Number of blocks; a concave domain gets a few more")
      ->capture_default_str();
  voronoi->add_option("--seed", options.seed, "The same seed gives the same blocks")
      ->check(not_negative, "")
      ->capture_default_str();
  voronoi->add_option("--lloyd", options.lloyd_steps, "Steps that make the blocks more even")
      ->capture_default_str();
  voronoi
      ->add_option("--smallest-edge", options.smallest_edge,
                   "Collapse shorter edges; relative to the size of a block, sqrt(area / cells)")
      ->capture_default_str();
}

int make(const MakeArguments& arguments) {
  try {
    make_voronoi(arguments);
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
