#include "measurement.hpp"

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace step_performance {

double Measurement::cholmod() const {
  const double by_amd = amd_factorization + amd_solution, by_metis = metis_factorization + metis_solution;
  return by_amd > 0 && by_metis > 0 ? std::min(by_amd, by_metis) : std::max(by_amd, by_metis);
}

const std::vector<Column>& columns() {
  using M = Measurement;
  static const std::vector<Column> all{{"scene", &M::scene},
                                       {"start", &M::start},
                                       {"method", &M::method},
                                       {"without", &M::without},
                                       {"status", &M::status},
                                       {"time_step", &M::time_step},
                                       {"threads", &M::threads},
                                       {"size", &M::size},
                                       {"blocks", &M::blocks},
                                       {"unknowns", &M::unknowns},
                                       {"steps", &M::steps},
                                       {"setup_s", &M::setup},
                                       {"total_s", &M::total},
                                       {"detection_s", &M::detection},
                                       {"assembly_s", &M::assembly},
                                       {"analysis_s", &M::analysis},
                                       {"factorization_s", &M::factorization},
                                       {"solution_s", &M::solution},
                                       {"solver_rest_s", &M::solver},
                                       {"update_s", &M::update},
                                       {"rest_s", &M::rest},
                                       {"output_s", &M::output},
                                       {"mean_s", &M::mean},
                                       {"substeps", &M::substeps},
                                       {"rejected", &M::rejected},
                                       {"iterations", &M::iterations},
                                       {"linear_solves", &M::linear_solves},
                                       {"factorizations", &M::factorizations},
                                       {"analyses", &M::analyses},
                                       {"contacts", &M::contacts},
                                       {"largest_speed", &M::largest_speed},
                                       {"peak_mb", &M::peak},
                                       {"heap_blocks_mb", &M::heap_blocks},
                                       {"heap_steps_mb", &M::heap_steps},
                                       {"factor_mb", &M::factor_memory},
                                       {"amd_analysis_s", &M::amd_analysis},
                                       {"amd_factorization_s", &M::amd_factorization},
                                       {"amd_solution_s", &M::amd_solution},
                                       {"amd_factor_mb", &M::amd_factor},
                                       {"metis_analysis_s", &M::metis_analysis},
                                       {"metis_factorization_s", &M::metis_factorization},
                                       {"metis_solution_s", &M::metis_solution},
                                       {"metis_factor_mb", &M::metis_factor},
                                       {"own_analysis_s", &M::own_analysis},
                                       {"own_factorization_s", &M::own_factorization},
                                       {"own_solution_s", &M::own_solution}};
  return all;
}

std::string header_line() {
  std::string line;
  for (const Column& column : columns()) line += fmt::format("{}{}", line.empty() ? "" : ",", column.first);
  return line;
}

std::string line_of(const Measurement& measurement) {
  std::string line;
  for (const Column& column : columns()) {
    if (&column != &columns().front()) line += ',';
    if (const auto* text = std::get_if<std::string Measurement::*>(&column.second))
      line += measurement.*(*text);
    else
      line += fmt::format("{:.4g}", measurement.*std::get<double Measurement::*>(column.second));
  }
  return line;
}

Measurement measurement_of(const std::string& line) try {
  Measurement measurement;
  std::istringstream fields(line);
  std::string field;
  for (const Column& column : columns()) {
    if (!std::getline(fields, field, ',')) throw polyfem::Error("it is too short");
    if (const auto* text = std::get_if<std::string Measurement::*>(&column.second))
      measurement.*(*text) = field;
    else
      measurement.*std::get<double Measurement::*>(column.second) = std::stod(field);
  }
  return measurement;
} catch (const std::exception& error) {
  throw polyfem::Error("no line of measurements, \"" + line + "\": " + error.what());
}

void write_table(const std::filesystem::path& path, const std::vector<Measurement>& table) {
  std::ofstream file(path);
  file << header_line() << '\n';
  for (const Measurement& measurement : table) file << line_of(measurement) << '\n';
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

std::vector<Measurement> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header_line())
    throw polyfem::Error("\"" + path.string() + "\" is no table of steps; run step_performance first");
  std::vector<Measurement> table;
  while (std::getline(file, line)) table.push_back(measurement_of(line));
  return table;
}

}  // namespace step_performance
