#include "cut.hpp"

#include "exit_status.hpp"
#include "messages.hpp"
#include "option_values.hpp"

#include <fmt/format.h>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/scene/blocks_reader.hpp>
#include <ddacontact/scene/geometry_writer.hpp>

namespace dda {

namespace {

std::string counted(int n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

void tell(const CutArguments& arguments, const ddacontact::Scene& before, const ddacontact::Scene& after,
          const ddacontact::CutCounts& counts) {
  if (before.snapped)
    say("{}: {} moved, by {:.3g} m at most\n", arguments.blocks,
        counted(before.snapped->moved, "vertex", "vertices"), before.snapped->farthest);
  say("{}: {} to {}: {} split, {} taken out, {} dropped\n", arguments.blocks,
      counted(static_cast<int>(before.blocks.size()), "block", "blocks"), after.blocks.size(), counts.split,
      counted(counts.short_edges, "short edge", "short edges"),
      counted(counts.straight_vertices, "straight vertex", "straight vertices"));
  if (counts.lost_holds > 0)
    say("{}: warning: {} in lists 'fixed' went with the cut\n", arguments.blocks,
        counted(counts.lost_holds, "vertex", "vertices"));
  if (counts.mixed_edges > 0)
    say("{}: warning: {} on edges of different joints: each follows the joint of the greatest length\n",
        arguments.blocks, counted(counts.mixed_edges, "new edge lies", "new edges lie"));
  if (!before.supports.empty() || !before.loads.empty() || !before.monitors.empty())
    say("{}: warning: supports, loads and monitors count vertices and edges as they were: they are left "
        "out\n",
        arguments.blocks);
}

int cut_file(const CutArguments& arguments) {
  const ddacontact::CutOptions& options = arguments.options;
  ddacontact::geometry_format(arguments.file);  // an unknown ending is an error before anything is computed
  const ddacontact::BlocksReading reading = ddacontact::read_blocks(arguments.blocks, arguments.snap);
  const int status = report(reading.scene);
  if (!reading.scene.scene) return status;
  ddacontact::CutCounts counts;
  const ddacontact::Scene scene = ddacontact::cut_blocks(*reading.scene.scene, options, counts);
  const auto kept = ddacontact::write_blocks(arguments.file, scene, reading.n_unnamed_materials);
  tell(arguments, *reading.scene.scene, scene, counts);
  tell_of_older(arguments.file, kept);
  fmt::print("{}: {} blocks\n", arguments.file, scene.blocks.size());
  return done;
}

}  // namespace

void add_cut(CLI::App& app, CutArguments& arguments) {
  CLI::App* cut = app.add_subcommand(
      "cut",
      "Convert and clean block geometry: snap vertices, remove short edges and collinear vertices, split "
      "concave blocks");
  cut->add_option("BLOCKS", arguments.blocks,
                  "Blocks: a scene (.toml), .geojson, .json, .wkt, .dxf, Shi's .geo, .msh or .vtu")
      ->required();
  cut->add_option("-o,--output", arguments.file,
                  "File to write: .geojson, .wkt, .dxf or .toml (a scene to run)")
      ->required()
      ->type_name("FILE");
  expect_positive_number(cut->add_option(
      "--snap", arguments.snap,
      "For rounded coordinates: merge vertices closer than this (m), and move them onto edges this close"));
  expect_number(
      cut->add_option("--shortest-edge", arguments.options.shortest_edge,
                      "Merge the two ends of shorter edges; relative to the size of their block, sqrt(area)"),
      0, 1);
  cut->add_flag("--drop-straight", arguments.options.drop_straight,
                "Leave out vertices on straight edges: the sine of their turn is at most 1e-9");
  cut->add_flag(
      "--convex", arguments.options.convex,
      "Split concave blocks into few convex ones: NAME.1, NAME.2, ...; the joint of a cut is that of "
      "the materials");
}

int cut(const CutArguments& arguments) {
  try {
    return cut_file(arguments);
  } catch (const ddacontact::OutputError& error) {
    print_error(error.what());
    return file_error;
  } catch (const ddacontact::Error& error) {
    print_error(error.what());
    return wrong_input;
  }
}

}  // namespace dda
