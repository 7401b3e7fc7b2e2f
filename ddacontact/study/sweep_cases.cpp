#include <ddacontact/study/sweep_cases.hpp>

#include <ddacontact/core/types.hpp>
#include <ddacontact/output/csv_table.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace ddacontact {

namespace {

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts{""};
  int depth = 0;
  bool in_quotes = false;
  for (const char c : text) {
    if (c == '"') in_quotes = !in_quotes;
    if (!in_quotes && (c == '[' || c == '{')) ++depth;
    if (!in_quotes && (c == ']' || c == '}')) --depth;
    if (c == separator && depth == 0 && !in_quotes)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw Error("'" + std::string(text) + "' " + what +
              " (write PATH=a,b,c or PATH=from:to:count or PATH=1..100)");
}

bool are_numbers(const std::vector<std::string>& parts) {
  return std::ranges::all_of(parts,
                             [](const std::string& part) { return number_of<double>(part).has_value(); });
}

[[noreturn]] void refuse_so_many(std::string_view of, std::string_view range) {
  refuse(of,
         "has the range '" + std::string(range) + "' of more than " + std::to_string(most_cases) + " values");
}

/// "1..100"; nothing when it is not of that form.
std::vector<std::string> whole_numbers(std::string_view text, std::string_view of) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return {};
  const auto first = number_of<long>(text.substr(0, dots)), last = number_of<long>(text.substr(dots + 2));
  if (number_of<double>(text.substr(0, dots)) && dots + 2 < text.size() && (!first || !last))
    refuse(of, "has '..' between what are no whole numbers");
  if (!first || !last) return {};
  if (*last < *first) refuse(of, "has the range '" + std::string(text) + "', which descends");
  if (static_cast<unsigned long>(*last) - static_cast<unsigned long>(*first) >= most_cases)
    refuse_so_many(of, text);
  std::vector<std::string> values;
  for (long k = *first; k <= *last; ++k) values.push_back(std::to_string(k));
  return values;
}

/// "from:to:count"; nothing when it is not numbers with colons.
std::vector<std::string> even_numbers(std::string_view text, std::string_view of) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() < 2 || !are_numbers(parts)) return {};
  if (parts.size() != 3) refuse(of, "has colons, but not from:to:count");
  const auto from = number_of<double>(parts[0]), to = number_of<double>(parts[1]);
  const auto count = number_of<long>(parts[2]);
  if (!count || *count < 2 || !std::isfinite(*from) || !std::isfinite(*to))
    refuse(of, "is no range of at least two numbers");
  if (*count > static_cast<long>(most_cases)) refuse_so_many(of, text);
  std::vector<std::string> values;
  for (long k = 0; k < *count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(*count - 1);
    values.push_back(scene_format::short_number((1 - t) * *from + t * *to));
  }
  return values;
}

SweepCases cases_of_table(const std::filesystem::path& table) {
  const CsvTable rows(table);
  const std::string name = "\"" + table.string() + "\"";
  SweepCases cases{rows.header(), {}};
  if (const std::size_t other = cases.paths[0].find_first_of(";\t");
      cases.paths.size() == 1 && other != std::string::npos)
    throw Error(name + " has " + (cases.paths[0][other] == ';' ? "';'" : "tabs") +
                " between its columns (write commas, and points in decimal numbers)");
  for (const std::string& path : cases.paths)
    if (std::ranges::count(cases.paths, path) > 1)
      throw Error(name + " has the column '" + path + "' twice (leave one out)");
  if (rows.n_rows() == 0) throw Error(name + " has no rows below its header (write one for each case)");
  cases.rows.resize(rows.n_rows());
  for (const std::string& path : cases.paths) {
    const std::vector<std::string> values = rows.texts(path);
    for (std::size_t k = 0; k < values.size(); ++k) cases.rows[k].push_back(values[k]);
  }
  return cases;
}

}  // namespace

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) refuse(text, "varies nothing");
  Variation variation{std::string(text.substr(0, equals)), {}};
  for (const std::string& part : split(text.substr(equals + 1), ',')) {
    std::vector<std::string> values = whole_numbers(part, text);
    if (values.empty()) values = even_numbers(part, text);
    if (values.empty()) values = {part};
    variation.values.insert(variation.values.end(), values.begin(), values.end());
  }
  if (std::ranges::count(variation.values, "") > 0) refuse(text, "has an empty value");
  return variation;
}

std::vector<std::string> SweepCases::settings(std::size_t row) const {
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < paths.size(); ++k) settings.push_back(paths[k] + '=' + rows[row][k]);
  return settings;
}

SweepCases sweep_cases(const std::vector<Variation>& variations, const std::filesystem::path& table) {
  SweepCases cases = table.empty() ? SweepCases{{}, {{}}} : cases_of_table(table);
  for (const Variation& variation : variations) {
    if (std::ranges::count(cases.paths, variation.path) > 0)
      throw Error("'" + variation.path + "' is varied twice (give all its values at once)");
    if (cases.rows.size() * variation.values.size() > most_cases)
      throw Error("the sweep has more than " + std::to_string(most_cases) + " cases (vary less)");
    cases.paths.push_back(variation.path);
    std::vector<std::vector<std::string>> rows;
    for (const std::vector<std::string>& row : cases.rows)
      for (const std::string& value : variation.values) {
        rows.push_back(row);
        rows.back().push_back(value);
      }
    cases.rows = std::move(rows);
  }
  if (cases.paths.empty()) throw Error("nothing varies (give --vary PATH=VALUES or --table CASES.csv)");
  return cases;
}

}  // namespace ddacontact
