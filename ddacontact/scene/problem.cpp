#include <ddacontact/scene/problem.hpp>

#include <algorithm>

namespace ddacontact {

std::string Problem::text() const {
  std::string text = file + ':' + std::to_string(line) + ':' + std::to_string(column) + ": ";
  text += severity == Severity::error ? "error: " : "warning: ";
  text += what;
  if (!cure.empty()) text += " (" + cure + ')';
  return text;
}

bool has_errors(const std::vector<Problem>& problems) {
  return std::any_of(problems.begin(), problems.end(),
                     [](const Problem& problem) { return problem.severity == Problem::Severity::error; });
}

}  // namespace ddacontact
