// Fills in the tables of a page and draws its pictures beside it: step_page MEASUREMENTS_DIRECTORY PAGE.md
#include <tests/performance/page/marked_page.hpp>
#include <tests/performance/steps/bars.hpp>
#include <tests/performance/steps/page_tables.hpp>
#include <tests/performance/steps/pictures.hpp>

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <exception>
#include <fstream>
#include <sstream>

using namespace step_performance;
using benchmark_page::markdown;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw polyfem::Error("\"" + path.string() + "\" is missing or empty");
  return text.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

void draw_pictures(const Tables& tables, const std::filesystem::path& directory) {
  const std::vector<SizeSeries> walls = size_series(tables.growth);
  write_file(directory / "dda_walls.svg", total_picture("Brick walls", walls));
  for (const SizeSeries& series : walls)
    for (const auto& [name, file] : {std::pair("wall, sudden, 0.0001 s", "dda_wall_dynamic.svg"),
                                     {"wall, sudden, 0.01 s", "dda_wall_settling.svg"}})
      if (series.name == name) write_file(directory / file, phase_picture(series));
  write_file(directory / "dda_scenes.svg", total_picture("All scenes", size_series(tables.scenes)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: step_page MEASUREMENTS_DIRECTORY PAGE.md\n");
    return 2;
  }
  try {
    const std::filesystem::path measurements = argv[1], path = argv[2];
    const Tables tables = read_tables(measurements);
    benchmark_page::MarkedPage page(path);
    page.fill("machine", text_of(measurements / "machine.txt"));
    page.fill("bars", markdown(bars_table(tables)));
    page.fill("growth", markdown(growth_table(tables.growth)));
    page.fill("phases", markdown(phase_table(tables.growth)));
    page.fill("factors", markdown(factor_table(tables.growth)));
    page.fill("memory", markdown(memory_table(tables.growth)));
    page.fill("scenes", markdown(phase_table(tables.scenes)));
    page.fill("scene growth", markdown(growth_table(tables.scenes)));
    page.fill("skips", markdown(skip_table(tables.skips)));
    page.fill("peers", markdown(peer_table(tables)));
    page.fill("threads", markdown(thread_table(tables.threads)));
    page.write();
    draw_pictures(tables, path.parent_path());
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_page: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
