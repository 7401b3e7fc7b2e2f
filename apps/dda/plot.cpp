#include "plot.hpp"

#include "call_error.hpp"
#include "exit_status.hpp"
#include "messages.hpp"
#include "picture_file.hpp"
#include "plot_curves.hpp"
#include "plot_numbers.hpp"
#include "result.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/magnified.hpp>
#include <ddacontact/picture/picture.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/study/scene_picture.hpp>

#include <filesystem>
#include <limits>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

Field field_called(const std::string& name) {
  if (const std::optional<Field> field = field_named(name)) return *field;
  std::vector<std::string_view> known;
  for (const FieldDescription& field : all_fields()) known.emplace_back(field.name);
  throw CallError(
      fmt::format("unknown field \"{}\" ({})", scene_format::excerpt(name), choice_among(name, known)));
}

std::string fields_of(const Frame& frame) {
  std::string names;
  for (const FieldDescription& field : all_fields())
    if (holds(frame, field.field)) names += fmt::format("{}{}", names.empty() ? "" : ", ", field.name);
  return names;
}

void expect_field(const Frame& frame, Field field, const fs::path& directory) {
  if (holds(frame, field)) return;
  throw CallError(
      fmt::format("the frames of \"{}\" do not hold \"{}\" (they hold: {}; [output] fields of the scene "
                  "says what a run keeps)",
                  directory.string(), description(field).name, fields_of(frame)));
}

/// A frame with what is told of it.
struct Shown {
  int scene = 0;  ///< the number of the directory
  fs::path directory;
  std::string label;  ///< of the directory
  std::vector<std::string> block_names;
  Frame frame;
  Frame drawn;  ///< with displacements magnified
  std::vector<BoltLine> bolts;
  Water water;
};

std::vector<Shown> read_frames(const PlotArguments& arguments) {
  std::vector<std::string> words = arguments.frames;
  if (words.empty()) words = {"last"};
  std::vector<Shown> all;
  for (std::size_t i = 0; i < arguments.directories.size(); ++i) {
    const fs::path directory(arguments.directories[i]);
    expect_result_directory(directory);
    const FrameSeries series = read_series(directory);
    const std::vector<std::string> names =
        arguments.names ? block_names(directory) : std::vector<std::string>();
    const std::optional<Scene> scene = scene_of(directory);
    if (!scene)
      say("dda: warning: \"{}\" cannot be read: water, if there was any, is not drawn\n",
          (directory / "scene.toml").string());
    for (const std::string& word : words) {
      Frame frame = read_frame(frame_of(series, word, directory));
      if (arguments.magnify != 1) expect_field(frame, Field::displacement, directory);
      Frame drawn = arguments.magnify != 1 ? magnified(frame, arguments.magnify) : frame;
      const Water water = scene ? water_at(directory, *scene, frame.step) : Water{};
      // Where bolts are is known at the end of the run, as it is.
      const bool has_bolts = arguments.magnify == 1 && frame.step == series.back().step;
      all.push_back({static_cast<int>(i), directory, name_of(directory), names, std::move(frame),
                     std::move(drawn), has_bolts ? bolts_of(directory) : std::vector<BoltLine>(), water});
    }
  }
  return all;
}

std::vector<Field> fields_to_show(const PlotArguments& arguments, const Frame& frame) {
  std::vector<Field> fields;
  for (const std::string& name : arguments.fields) fields.push_back(field_called(name));
  if (fields.empty()) fields.push_back(holds(frame, Field::s2) ? Field::s2 : Field::none);
  return fields;
}

std::vector<VectorKind> vectors_to_show(const PlotArguments& arguments) {
  std::vector<VectorKind> kinds;
  if (arguments.crosses) kinds.push_back(VectorKind::principal_stresses);
  if (arguments.forces) kinds.push_back(VectorKind::contact_forces);
  if (arguments.vectors == "displacement") kinds.push_back(VectorKind::displacement);
  if (arguments.vectors == "velocity") kinds.push_back(VectorKind::velocity);
  return kinds;
}

void expect_overlays(const PlotArguments& arguments, const Shown& shown) {
  if (arguments.reference) expect_field(shown.frame, Field::displacement, shown.directory);
  if (arguments.vectors == "displacement") expect_field(shown.frame, Field::displacement, shown.directory);
  if (arguments.vectors == "velocity") expect_field(shown.frame, Field::velocity, shown.directory);
  if (arguments.crosses) expect_field(shown.frame, Field::s1, shown.directory);
}

std::string caption(const PlotArguments& arguments, const Shown& shown) {
  std::string moment = fmt::format("step {}, t = {:.4g} s", shown.frame.step, shown.frame.time);
  if (arguments.magnify != 1) moment += fmt::format(", displacements x {:g}", arguments.magnify);
  return arguments.directories.size() > 1 ? shown.label + ": " + moment : moment;
}

PictureOptions picture_options(const PlotArguments& arguments, const std::vector<Field>& fields) {
  PictureOptions options;
  if (arguments.width > 0) {
    options.height *= arguments.width / options.width;
    options.width = arguments.width;
  }
  options.reference = arguments.reference;
  options.names = arguments.names;
  options.thrust = arguments.thrust;
  options.vectors = vectors_to_show(arguments);
  options.sharing = arguments.own_range ? RangeSharing::none : RangeSharing::all;
  if (!arguments.range.empty()) options.range = colour_range(arguments.range, fields);
  if (!arguments.window.empty()) options.window = window(arguments.window);
  // Fields beside each other, else moments beside each other, else whatever makes the blocks largest.
  const std::size_t n_fields = fields.size(), n_frames = arguments.frames.size(),
                    n = arguments.directories.size();
  if (n_fields > 1 && n_frames + n > 2) options.columns = static_cast<int>(n_fields);
  if (n_fields == 1 && n_frames > 1 && n > 1) options.columns = static_cast<int>(n_frames);
  if (n == 1)
    options.title = title_of(arguments.directories.front(), scene_of(arguments.directories.front()));
  return options;
}

/// A picture of nothing is a window in other coordinates.
void expect_in_window(const std::vector<Shown>& all, const Window& window, const std::string& text) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Shown& shown : all) {
    if (shown.drawn.position.cols() == 0) continue;
    low = low.cwiseMin(shown.drawn.position.rowwise().minCoeff());
    high = high.cwiseMax(shown.drawn.position.rowwise().maxCoeff());
  }
  if ((window.low.array() > high.array()).any() || (window.high.array() < low.array()).any())
    throw CallError(
        fmt::format("--window \"{}\" shows nothing: the blocks are between {:.4g} and {:.4g} in x, "
                    "{:.4g} and {:.4g} in y",
                    text, low.x(), high.x(), low.y(), high.y()));
}

std::string blocks_picture(const PlotArguments& arguments) {
  for (const std::string& name : arguments.fields) field_called(name);  // a wrong call before a wrong file
  const std::vector<Shown> all = read_frames(arguments);
  const std::vector<Field> fields = fields_to_show(arguments, all.front().frame);
  const PictureOptions options = picture_options(arguments, fields);
  if (options.window) expect_in_window(all, *options.window, arguments.window);
  std::vector<Panel> panels;
  for (const Shown& shown : all) {
    expect_overlays(arguments, shown);
    for (const Field field : fields) {
      expect_field(shown.frame, field, shown.directory);
      panels.push_back({&shown.drawn, field, caption(arguments, shown), shown.block_names, shown.scene,
                        &shown.frame, shown.bolts, shown.water});
    }
  }
  return draw(panels, options);
}

void check_call(const PlotArguments& arguments) {
  expect_picture_name(arguments.output);
  const bool curves = arguments.has_curves();
  const bool blocks = !arguments.fields.empty() || !arguments.frames.empty() || arguments.reference ||
                      arguments.forces || arguments.crosses || arguments.thrust || arguments.names ||
                      arguments.magnify != 1 || arguments.own_range || !arguments.vectors.empty() ||
                      !arguments.range.empty() || !arguments.window.empty();
  if (curves && blocks)
    throw CallError(
        "--history, --energy, --unbalanced, --bolts and --reactions draw curves; what belongs to pictures of "
        "blocks cannot be given with them");
  if (!arguments.monitors.empty() && arguments.history.empty())
    throw CallError("--monitor chooses among the curves of --history; give that too");
}

bool are_of_scenes(const PlotArguments& a) {
  return a.fields.empty() && a.frames.empty() && !a.reference && !a.forces && !a.crosses && !a.thrust &&
         !a.own_range && a.magnify == 1 && a.vectors.empty() && a.range.empty() && a.window.empty() &&
         a.monitors.empty() && !a.has_curves();
}

/// A scene has no results: options of these are refused.
int plot_scene(const PlotArguments& arguments) {
  try {
    PlotArguments blocks = arguments;
    blocks.names = false;
    check_call(blocks);
    if (!are_of_scenes(arguments))
      throw CallError(
          "a scene is drawn with --names, --numbers, --width and --set alone: the others are of results");
    const SceneReading reading = read_scene(arguments.directories[0], arguments.settings);
    if (const int status = report(reading); !reading.scene) return status;
    ScenePictureOptions options{.names = arguments.names, .numbers = arguments.numbers};
    if (arguments.width > 0) options.width = arguments.width;
    write_picture(arguments.output, draw(*reading.scene, options));
    return done;
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const Error& error) {
    print_error(error.what());
    return file_error;
  }
}

}  // namespace

int plot(const PlotArguments& call) {
  if (call.directories.size() == 1 && fs::path(call.directories[0]).extension() == ".toml")
    return plot_scene(call);
  PlotArguments arguments = call;
  for (std::vector<std::string>* list : {&arguments.fields, &arguments.frames, &arguments.history})
    *list = single_words(*list);
  try {
    if (arguments.numbers || !arguments.settings.empty())
      throw CallError("--numbers and --set belong to the picture of a scene (.toml)");
    check_call(arguments);
    write_picture(arguments.output,
                  arguments.has_curves() ? curves_picture(arguments) : blocks_picture(arguments));
    return done;
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const Error& error) {
    print_error(error.what());
    return file_error;
  }
}

}  // namespace dda
