#include <ddacontact/scene/names.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <charconv>

namespace ddacontact::scene_format {

namespace {

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || text[0] == '-') return std::nullopt;
  return value;
}

}  // namespace

void NameTable::add(const std::optional<std::string>& name, const KeyLocations& locations,
                    ProblemList& problems, const std::string& origin) {
  const int index = size();
  const std::string of_origin = origin.empty() ? "" : " of " + origin;
  origins_.push_back(of_origin);
  names_.push_back(name.value_or(""));
  if (!name || !locations.good("name")) return;
  const SourceLocation& location = locations.of("name");
  if (name->empty()) {
    problems.error(location, "'name' = ''" + of_origin + " is empty", "write a name or leave it out");
    return;
  }
  if (std::any_of(name->begin(), name->end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    problems.error(location, "'name' = '" + excerpt(*name) + "'" + of_origin + " holds control characters",
                   "use letters and digits");
  if (whole_number(*name)) number_names_.emplace_back(index, location);
  const auto [known, is_new] = indices_.emplace(*name, index);
  if (!is_new)
    problems.error(location,
                   "the name '" + excerpt(*name) + "'" + of_origin + " is taken by " + kind_ + ' ' +
                       std::to_string(known->second),
                   "give each " + kind_ + " a name of its own");
}

int NameTable::find(const Reference& reference, const SourceLocation& location, ProblemList& problems,
                    const std::string& asked_by) const {
  if (!reference.index) {
    if (const auto known = indices_.find(reference.name); known != indices_.end()) return known->second;
  }
  const std::optional<std::int64_t> index = reference.index ? reference.index : whole_number(reference.name);
  if (index && *index >= 0 && *index < size()) return static_cast<int>(*index);
  if (incomplete_) return -1;
  const std::string of_asker = asked_by.empty() ? "" : " of " + asked_by;
  const std::string range =
      size() == 0 ? "there is no " + kind_ : "indices run from 0 to " + std::to_string(size() - 1);
  if (index) {
    problems.error(location, "unknown " + kind_ + " '" + std::to_string(*index) + "'" + of_asker, range);
    return -1;
  }
  std::string cure = range;
  if (!indices_.empty() && problems.may_suggest()) {
    std::vector<std::string_view> known;
    for (const std::string& name : names_)
      if (!name.empty()) known.emplace_back(name);
    cure = suggestion(reference.name, kind_, known);
  }
  problems.error(location, "unknown " + kind_ + " '" + excerpt(reference.name) + "'" + of_asker, cure);
  return -1;
}

void NameTable::warn_of_ambiguous_names(ProblemList& problems) const {
  for (const auto& [member, location] : number_names_) {
    const std::int64_t index = *whole_number(names_[member]);
    if (index < size() && names_[index].empty() && names_[member] == std::to_string(index))
      problems.warning(location,
                       "results call " + kind_ + " " + names_[member] + ", which has no name, the same",
                       "choose another name");
  }
}

std::string NameTable::title(int index) const {
  const std::string& name = names_[index];
  return kind_ + ' ' + (name.empty() ? std::to_string(index) : "'" + excerpt(name) + "'") + origins_[index];
}

}  // namespace ddacontact::scene_format
