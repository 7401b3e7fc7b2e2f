#include <ddacontact/output/summary_reader.hpp>

#include <ddacontact/core/types.hpp>

#include <nlohmann/json.hpp>

#include <fstream>

namespace ddacontact {

namespace {

void collect(const nlohmann::json& object, const std::string& prefix, SummaryTable& summary) {
  for (const auto& [key, value] : object.items()) {
    summary.keys.insert(prefix + key);
    if (value.is_structured())
      collect(value, prefix + key + ".", summary);
    else if (value.is_number())
      summary.numbers[prefix + key] = value.get<double>();
    else if (value.is_boolean())
      summary.numbers[prefix + key] = value.get<bool>() ? 1 : 0;
    else if (value.is_string())
      summary.texts[prefix + key] = value.get<std::string>();
  }
}

}  // namespace

std::optional<double> SummaryTable::number(const std::string& key) const {
  const auto found = numbers.find(key);
  return found == numbers.end() ? std::nullopt : std::optional<double>(found->second);
}

std::string SummaryTable::text(const std::string& key) const {
  const auto found = texts.find(key);
  return found == texts.end() ? std::string() : found->second;
}

SummaryTable read_summary(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("cannot read \"" + path.string() + "\"");
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) throw Error("\"" + path.string() + "\" is damaged: it is no JSON object");
  SummaryTable summary;
  collect(json, "", summary);
  return summary;
}

}  // namespace ddacontact
