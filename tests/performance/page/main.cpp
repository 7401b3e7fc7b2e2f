// Fills in the tables of a page and draws its pictures beside it: benchmark_page MEASUREMENTS_DIRECTORY
// PAGE.md
#include <tests/performance/page/kernel_section.hpp>
#include <tests/performance/page/quadrature_section.hpp>
#include <tests/performance/page/work_precision_section.hpp>

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <exception>
#include <fstream>
#include <sstream>

using namespace benchmark_page;

namespace {

struct Chapter {
  std::string problem, name, title;
  std::string first_error = "L2 error";
};

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

void fill_work_precision(const std::filesystem::path& measurements, const std::filesystem::path& directory,
                         MarkedPage& page) {
  const std::vector<Chapter> chapters{
      {"manufactured", "manufactured", "A smooth solution"},
      {"cantilever", "cantilever", "Cantilever"},
      {"Cook", "cook", "Cook's membrane", "displacement error"},
      {"plate with a hole", "hole", "Plate with a hole"},
      {"nearly incompressible", "incompressible", "Cantilever, Poisson's ratio 0.4999"}};
  const auto table = work_precision::read_table(measurements / "work_precision.csv");
  for (const auto& [problem, name, title, first_error] : chapters) {
    const std::vector<Series> all = series_of(table, problem);
    const std::vector<double> small =
        name == "manufactured" ? std::vector{1e-5, 1e-6} : std::vector<double>{};  // for second order
    page.fill(name, markdown(finest_meshes(all, first_error)) + '\n' +
                        markdown(times_to_errors(all, first_error, &Measurement::l2, {16, 4, 1}, small)) +
                        '\n' +
                        markdown(times_to_errors(all, "energy error", &Measurement::energy, {4, 2, 1})));
    write_file(directory / (name + ".svg"), work_precision_picture(title, all, first_error));
  }
}

/// The whole file. Throws Error when it is missing.
std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw polyfem::Error("\"" + path.string() + "\" is missing or empty");
  return text.str();
}

/// Of the lines that voronoi_cantilever has printed.
Table cantilever_table(const std::filesystem::path& path) {
  Table table{{"cells", "unknowns", "L2 error", "energy error", "solved in, s", "mesh before that, s",
               "largest memory, MB"}};
  std::istringstream lines(text_of(path));
  for (std::string line; std::getline(lines, line);) {
    table.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
  }
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: benchmark_page MEASUREMENTS_DIRECTORY PAGE.md\n");
    return 2;
  }
  try {
    const std::filesystem::path measurements = argv[1], path = argv[2];
    MarkedPage page(path);
    page.fill("machine", text_of(measurements / "machine.txt"));
    page.fill("cook reference", text_of(measurements / "reference.txt"));
    fill_work_precision(measurements, path.parent_path(), page);
    const std::vector<Row> rules = read_rows(measurements / "quadrature_rules.csv");
    page.fill("quadrature", markdown(points_table(rules)));
    page.fill("tolerances", markdown(tolerance_table(read_rows(measurements / "quadrature_tolerances.csv"))));
    write_file(path.parent_path() / "quadrature.svg", quadrature_picture(rules));
    const auto times = [&](const std::string& program) {
      return kernel_times(measurements / (program + ".json"));
    };
    const KernelTimes generic = times("basis_performance"), native = times("basis_performance_native");
    page.fill("wachspress", markdown(basis_table("wachspress", generic, native)));
    page.fill("mean value", markdown(basis_table("mean_value", generic, native)));
    page.fill("quadrilaterals", markdown(quadrilateral_table(times("element_performance"))));
    page.fill("elements", markdown(element_table(times("element_performance"))));
    page.fill("voronoi cantilever", markdown(cantilever_table(measurements / "voronoi_cantilever.csv")));
    page.write();
  } catch (const std::exception& error) {
    fmt::print(stderr, "benchmark_page: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
