#include <tests/performance/work_precision/measurement_table.hpp>

#include <polyfem/core/error.hpp>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace work_precision {
namespace {

constexpr const char* header =
    "problem,method,solver,cells,unknowns,error_l2,error_energy,mesh_s,pattern_s,assembly_s,factorization_s,"
    "solve_s,total_s";

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

void write_table(const std::filesystem::path& path, const std::vector<Measurement>& measurements) {
  std::ofstream file(path);
  file << header << '\n' << std::setprecision(4);
  for (const Measurement& m : measurements)
    file << m.problem << ',' << m.method << ',' << m.solver << ',' << m.n_cells << ',' << m.n_unknowns << ','
         << m.l2 << ',' << m.energy << ',' << m.mesh << ',' << m.pattern << ',' << m.assembly << ','
         << m.factorization << ',' << m.solve << ',' << m.total() << '\n';
  file.close();
  if (!file) throw polyfem::Error("cannot write \"" + path.string() + "\"");
}

std::vector<Measurement> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header)
    throw polyfem::Error("\"" + path.string() + "\" is no table of measurements; run work_precision first");
  std::vector<Measurement> measurements;
  while (std::getline(file, line)) {
    const std::vector<std::string> f = fields_of(line);
    if (f.size() != 13) throw polyfem::Error("\"" + path.string() + "\" has a line that is cut off: " + line);
    measurements.push_back({f[0], f[1], f[2], std::stoi(f[3]), std::stoi(f[4]), std::stod(f[5]),
                            std::stod(f[6]), std::stod(f[7]), std::stod(f[8]), std::stod(f[9]),
                            std::stod(f[10]), std::stod(f[11])});
  }
  return measurements;
}

}  // namespace work_precision
