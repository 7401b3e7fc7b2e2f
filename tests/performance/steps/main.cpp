// What a step costs, by phase, over scenes of any size:
//
//     step_performance run -o FILE.csv [--scenes ...] [--sizes ...] ...   measures
//     step_performance results DIRECTORY... -o FILE.csv                   the same of runs of the program
//     step_performance draw FILE.csv -o DIRECTORY                         a picture of each scene over sizes
//     step_performance scene NAME SIZE -o FILE.toml                       a scene for the program
//
// Each case runs in a process of its own, one after another; `--help` of a verb names its options.
#include <malloc.h>
#include <tests/performance/steps/case.hpp>
#include <tests/performance/steps/growth.hpp>
#include <tests/performance/steps/in_child.hpp>
#include <tests/performance/steps/pictures.hpp>
#include <tests/performance/steps/results.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <ddacontact/scene/writer.hpp>
#include <polyfem/core/error.hpp>
#include <tests/performance/scenes.hpp>

#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace step_performance;

namespace {

struct Arguments {
  std::filesystem::path output, table;
  std::vector<std::filesystem::path> results;
  std::string scene;
  int size = 0, steps = 1;
  std::vector<std::string> scenes{"wall"}, starts{"sudden"}, without{"none"};
  std::vector<int> sizes{1000}, threads{1};
  std::vector<double> time_steps{1e-2};
  std::vector<std::string> methods{"default"};
  bool append = false;
  Effort effort;
};

void print(const Measurement& m) {
  const auto ms = [](double seconds) { return 1e3 * seconds; };
  fmt::print(
      "{:<10} {:<8} {:<8} {:>7} s {:>8} blocks {:<10} {:>9.3g} ms: detection {:.3g}, assembly {:.3g}, "
      "analysis "
      "{:.3g}, factorization {:.3g}, solution {:.3g}, solver {:.3g}, update {:.3g}, rest {:.3g}; CHOLMOD "
      "{:.3g}; "
      "{:.3g} iterations, {:.3g} factorizations; {:.0f} MB; {}\n",
      m.scene, m.start, m.method, m.time_step, m.blocks, m.without, ms(m.total), ms(m.detection),
      ms(m.assembly), ms(m.analysis), ms(m.factorization), ms(m.solution), ms(m.solver), ms(m.update),
      ms(m.rest), ms(m.cholmod()), m.iterations, m.factorizations, m.peak, m.status);
  std::fflush(stdout);
}

Measurement measure_apart(const Case& what, const Effort& effort) {
  // Setting up, a last step and CHOLMOD come on top of the seconds allowed.
  const ChildResult result =
      run_in_child([&] { return line_of(measure(what, effort)); }, static_cast<int>(4 * effort.seconds) + 20);
  if (result.end == ChildResult::End::done) return measurement_of(result.text);
  Measurement row = row_of(what);
  row.status = result.end == ChildResult::End::too_long ? "over the limit of time"
                                                        : fmt::format("failed: {}", result.text);
  std::ranges::replace(row.status, ',', ';');
  return row;
}

/// Of growing size, until one is not done in time.
void measure_sizes(const Arguments& arguments, Case what, std::vector<Measurement>& table) {
  for (const int size : arguments.sizes) {
    what.size = size;
    table.push_back(measure_apart(what, arguments.effort));
    print(table.back());
    write_table(arguments.output, table);  // what is there stays when the run is broken off
    if (table.back().steps == 0) return;
  }
}

void run(const Arguments& arguments) {
  std::vector<Measurement> table;
  if (arguments.append && std::filesystem::exists(arguments.output)) table = read_table(arguments.output);
  Case what;
  for (const std::string& method : arguments.methods)
    for (const std::string& scene : arguments.scenes)
      for (const double time_step : arguments.time_steps)
        for (const std::string& start : arguments.starts)
          for (const std::string& without : arguments.without)
            for (const int threads : arguments.threads) {
              what.method = method;
              what.scene = scene;
              what.time_step = time_step;
              what.settled = start == "settled";
              what.without =
                  without == "none" ? std::vector<std::string>{} : CLI::detail::split(without, '+');
              what.threads = threads;
              measure_sizes(arguments, what, table);
            }
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

std::string file_name(std::string name) {
  for (char& c : name)
    if (c == ',' || c == ' ' || c == '/') c = '_';
  return name + ".svg";
}

void write_scene_file(const Arguments& arguments) {
  ddacontact::Scene scene = performance::make_scene(arguments.scene, arguments.size);
  performance::set_time_step(scene, arguments.time_steps.front());
  scene.analysis.steps = arguments.steps;
  std::ostringstream text;
  ddacontact::write_scene(text, scene);
  write_file(arguments.output, text.str());
}

void draw(const Arguments& arguments) {
  for (const SizeSeries& series : size_series(read_table(arguments.table))) {
    write_file(arguments.output / file_name(series.name), phase_picture(series));
    std::vector<double> blocks, seconds;
    for (const Measurement& row : series.rows) {
      blocks.push_back(row.blocks);
      seconds.push_back(row.total);
    }
    fmt::print("{}: time grows with the power {:.2f} of the blocks\n", series.name,
               growth_exponent(blocks, seconds));
  }
}

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // as the program does
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  Arguments arguments;
  CLI::App app("What a step costs");
  app.require_subcommand(1);
  CLI::App* const measuring = app.add_subcommand("run", "Measure steps of scenes");
  measuring->add_option("-o,--output", arguments.output, "The table to write")->required();
  measuring->add_flag("--append", arguments.append, "Keep what the table holds already");
  measuring->add_option(
      "--scenes", arguments.scenes,
      "wall glide arch heap loose_heap smooth_heap slope slide bin tunnel filled_arch rain field columns");
  measuring->add_option("--sizes", arguments.sizes, "Numbers of blocks, ascending");
  measuring->add_option("--time-steps", arguments.time_steps, "Lengths of steps, s");
  measuring->add_option("--starts", arguments.starts, "From what")
      ->check(CLI::IsMember({"sudden", "settled"}));
  measuring->add_option("--without", arguments.without,
                        "Skips switched off, joined by +: a case for each word; none: all on");
  measuring->add_option("--threads", arguments.threads, "Numbers of threads");
  measuring
      ->add_option("--methods", arguments.methods, "Classical DDA, the explicit scheme, contacts to 1e-3")
      ->check(CLI::IsMember({"default", "classic", "explicit", "coarse"}));
  measuring->add_option("--warm", arguments.effort.warm_steps, "Steps before those measured");
  measuring->add_option("--steps", arguments.effort.steps, "Steps measured");
  measuring->add_option("--seconds", arguments.effort.seconds, "No step is begun after these");
  measuring->add_flag("!--no-cholmod", arguments.effort.cholmod, "Leave CHOLMOD's own time out");
  measuring->add_option("--factor-mb", arguments.effort.factor_mb, "And where its factor would be larger");
  CLI::App* const reading = app.add_subcommand("results", "Tabulate runs of the program");
  reading->add_option("directories", arguments.results, "Result directories")->required();
  reading->add_option("-o,--output", arguments.output, "The table to write")->required();
  CLI::App* const drawing = app.add_subcommand("draw", "Draw a table");
  drawing->add_option("table", arguments.table, "The table")->required();
  drawing->add_option("-o,--output", arguments.output, "Directory of the pictures")->required();
  CLI::App* const writing = app.add_subcommand("scene", "Write a scene for the program");
  writing->add_option("name", arguments.scene, "As --scenes of run")->required();
  writing->add_option("size", arguments.size, "Number of blocks")->required();
  writing->add_option("-o,--output", arguments.output, "The file to write")->required();
  writing->add_option("--time-steps", arguments.time_steps, "Length of the steps, s");
  writing->add_option("--steps", arguments.steps, "How many");
  CLI11_PARSE(app, argc, argv);
  try {
    if (*measuring) run(arguments);
    if (*drawing) draw(arguments);
    if (*writing) write_scene_file(arguments);
    if (*reading) {
      std::vector<Measurement> table;
      for (const std::filesystem::path& directory : arguments.results) {
        table.push_back(measurement_of_result(directory));
        print(table.back());
      }
      write_table(arguments.output, table);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_performance: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
