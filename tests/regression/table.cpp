#include "table.hpp"

#include <ddacontact/output/csv_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace regression {

namespace {

constexpr const char* header = "scene,quantity,expectation,value,tolerance,unit,source";

Expectation expectation_from(const std::string& word) {
  for (Expectation one : {Expectation::computed, Expectation::bound, Expectation::known})
    if (name_of(one) == word) return one;
  throw ddacontact::Error("no expectation is called \"" + word + "\" (computed, bound or known)");
}

double ratio(double difference, double allowed) {
  if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
  return difference == 0 ? 0 : difference / allowed;
}

/// As many digits as the tolerance makes sense of, and three more.
std::string rounded(double value, double tolerance) {
  const double step = tolerance / 1000;
  if (step == 0) return fmt::format("{:.12g}", value);
  if (std::abs(value) < step) return "0";
  const int digits = static_cast<int>(std::ceil(std::log10(std::abs(value) / step)));
  return fmt::format("{:.{}g}", value, std::clamp(digits, 1, 15));
}

}  // namespace

std::string name_of(Expectation expectation) {
  switch (expectation) {
    case Expectation::computed:
      return "computed";
    case Expectation::bound:
      return "bound";
    case Expectation::known:
      return "known";
  }
  return "";
}

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

void write_table(const std::filesystem::path& file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << header << '\n';
  for (const Row& row : rows)
    out << fmt::format("{},{},{},{},{:.2g},{},{}\n", row.scene, row.quantity, name_of(row.expectation),
                       row.expectation == Expectation::computed ? rounded(row.value, row.tolerance)
                                                                : fmt::format("{:.12g}", row.value),
                       row.tolerance, row.unit, row.source);
  if (!out.flush()) throw ddacontact::Error("cannot write \"" + file.string() + "\"");
}

}  // namespace regression
