#include "table.hpp"

#include <ddacontact/output/csv_table.hpp>

#include <cmath>
#include <limits>

namespace regression {

namespace {

Expectation expectation_from(const std::string& word) {
  if (word == "known") return Expectation::known;
  if (word == "bound") return Expectation::bound;
  throw ddacontact::Error("no expectation is called \"" + word + "\" (bound or known)");
}

double ratio(double difference, double allowed) {
  if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
  return difference == 0 ? 0 : difference / allowed;
}

}  // namespace

double Row::deviation(double seen) const {
  return expectation == Expectation::bound ? ratio(std::abs(seen), value)
                                           : ratio(std::abs(seen - value), tolerance);
}

std::vector<Row> read_table(const std::filesystem::path& file) {
  const ddacontact::CsvTable table(file);
  const auto scenes = table.texts("scene"), quantities = table.texts("quantity"),
             expectations = table.texts("expectation"), units = table.texts("unit"),
             sources = table.texts("source");
  const auto values = table.numbers("value"), tolerances = table.numbers("tolerance");
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i)
    rows.push_back({scenes[i], quantities[i], expectation_from(expectations[i]), values[i], tolerances[i],
                    units[i], sources[i]});
  return rows;
}

}  // namespace regression
