#include "page.hpp"

#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <fstream>

namespace stability {

LongRecord read_long_record(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw polyfem::Error("cannot read \"" + path + "\"");
  LongRecord record;
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    if (second == std::string::npos) throw polyfem::Error("\"" + path + "\": not a record: " + line);
    record[line.substr(0, first)] = {line.substr(second + 1),
                                     line.substr(first + 1, second - first - 1) == "yes"};
  }
  return record;
}

Report& Page::begin(const Row& row) {
  rows_.push_back({row});
  report_.heading(fmt::format("{}. {}", rows_.size(), row.test));
  report_.paragraph(fmt::format("Passes when: {}. Tests: {}.", row.passes_when, row.where));
  return report_;
}

void Page::claims(const std::vector<Claim>& claims) {
  Summary& summary = rows_.back();
  for (const Claim& claim : claims) {
    ++summary.claims;
    summary.seen += claim.seen;
  }
  report_.claims(claims);
}

Claim Page::quoted(const std::string& page, const std::string& said) {
  std::ifstream in(std::string(POLYDDA_VERIFICATION) + "/" + page);
  const std::string begin = "| " + said + " | ", yes = "yes | ", no = "**no** | ";
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(begin)) continue;
    const std::string rest = line.substr(begin.size());
    const bool seen = rest.starts_with(yes);
    if (!seen && !rest.starts_with(no)) break;
    const std::size_t from = seen ? yes.size() : no.size();
    return {said, seen, fmt::format("{} ({})", rest.substr(from, rest.rfind(" |") - from), page)};
  }
  throw polyfem::Error("\"" + page + "\" does not say \"" + said + "\"");
}

Claim Page::recorded(const std::string& said, const std::string& name) const {
  const auto entry = recorded_.find(name);
  if (entry == recorded_.end()) return {said, false, "not recorded yet (long suite)"};
  return {said, entry->second.passes, entry->second.figures + " (long suite)"};
}

void Page::write(const std::string& front) const {
  std::string table = "| test | passes when | value |\n|---|---|---|\n";
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Summary& summary = rows_[k];
    table += fmt::format("| {}. {} | {} | {} |\n", k + 1, summary.row.test, summary.row.passes_when,
                         summary.claims == 0 ? "by its tests"
                         : summary.seen == summary.claims
                             ? "all"
                             : fmt::format("**{} of {}**", summary.seen, summary.claims));
  }
  report_.write("stability", fmt::format(fmt::runtime(front), report_.n_claims(), report_.n_seen()) + table);
}

std::string figure(double value) {
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

}  // namespace stability
