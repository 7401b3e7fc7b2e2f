#include "plot_options.hpp"

#include "option_values.hpp"

#include <ddacontact/picture/field.hpp>

namespace dda {

namespace {

void declare_what(CLI::App& plot, PlotArguments& call) {
  plot.add_option(
          "DIR", call.directories,
          "Result directories, drawn beside each other; or one scene (TOML), drawn as it is before it is run")
      ->required();
  plot.add_option("-o,--output", call.output, "The picture to write: .svg, .png or .pdf")
      ->required()
      ->type_name("FILE");
  expect_whole_number(
      plot.add_option("--width", call.width, "Largest width in pixels; PNG files have two dots a pixel"), 200,
      20000);
}

void declare_blocks(CLI::App& plot, PlotArguments& call) {
  constexpr const char* blocks = "Blocks";
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* type,
                        const char* text) {
    plot.add_option(name, values, text)->take_all()->expected(1)->type_name(type)->group(blocks);
  };
  const auto flag = [&](const char* name, bool& value, const char* text) {
    plot.add_flag(name, value, text)->group(blocks);
  };
  std::string names;
  for (const ddacontact::FieldDescription& field : ddacontact::all_fields())
    names += std::string(field.name) + ", ";
  list("--field", call.fields, "NAME",
       ("Colours: " + names + "several with commas, or repeated. Left out: s2, or none without stress")
           .c_str());
  list("--frame", call.frames, "STEP",
       "The number of a step, or last; several with commas, or repeated. Left out: last");
  flag("--reference", call.reference, "Outlines at the start, dashed");
  flag("--forces", call.forces, "Contact forces on the upper of the two blocks, as arrows");
  expect_word(plot.add_option("--vectors", call.vectors, "An arrow for each block: displacement or velocity"),
              {"displacement", "velocity"})
      ->group(blocks);
  flag("--crosses", call.crosses, "Mean principal stresses of each block, as lines along their directions");
  flag("--thrust", call.thrust,
       "The line of thrust of masonry: through each block that two others load, from joint to joint");
  flag("--names", call.names, "Names of the blocks");
  flag("--numbers", call.numbers, "Of a scene: numbers of vertices and edges");
  expect_number(plot.add_option("--magnify", call.magnify,
                                "Draw displacements larger by this factor; fields stay as they are"),
                0, 1e9)
      ->group(blocks);
  list("--set", call.settings, "PATH=VALUE", "Of a scene: replace a value; may be repeated");
  plot.add_option("--range", call.range, "Of the colours, with units or in SI")
      ->type_name("MIN,MAX")
      ->group(blocks);
  flag("--own-range", call.own_range,
       "Colours of each picture cover its own values, not those of all pictures");
  plot.add_option("--window", call.window, "The part to show")
      ->type_name("XMIN,XMAX,YMIN,YMAX")
      ->group(blocks);
}

void declare_curves(CLI::App& plot, PlotArguments& call) {
  constexpr const char* curves = "Curves";
  plot.add_option("--history", call.history,
                  "Of monitors: x, y, ux, uy, vx or vy; several with commas, or repeated")
      ->take_all()
      ->expected(1)
      ->type_name("NAME")
      ->group(curves);
  plot.add_option("--monitor", call.monitors, "Only this one; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("NAME")
      ->group(curves);
  plot.add_flag("--energy", call.energy, "Energies over time")->group(curves);
  plot.add_flag("--unbalanced", call.unbalanced, "Out-of-balance force and largest velocity over time")
      ->group(curves);
  plot.add_flag("--bolts", call.bolt_forces, "Largest axial force of each bolt over time")->group(curves);
  plot.add_flag("--reactions", call.reactions, "Forces of supports on each block over time")->group(curves);
}

}  // namespace

void declare_plot(CLI::App& app, PlotArguments& arguments) {
  CLI::App* plot =
      app.add_subcommand("plot", "Draw results as SVG, PNG or PDF: blocks in colours, or curves over time");
  declare_what(*plot, arguments);
  declare_blocks(*plot, arguments);
  declare_curves(*plot, arguments);
}

}  // namespace dda
