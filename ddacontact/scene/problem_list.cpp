#include <ddacontact/scene/problem_list.hpp>

#include <algorithm>
#include <set>
#include <tuple>

namespace ddacontact::scene_format {

namespace {

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

}  // namespace

void ProblemList::error(const SourceLocation& location, std::string what, std::string cure) {
  add(Problem::Severity::error, location, std::move(what), std::move(cure));
}

void ProblemList::warning(const SourceLocation& location, std::string what, std::string cure) {
  add(Problem::Severity::warning, location, std::move(what), std::move(cure));
}

void ProblemList::add(Problem::Severity severity, const SourceLocation& location, std::string what,
                      std::string cure) {
  problems_.push_back({severity, on_one_line(location.source ? *location.source : file_), location.line,
                       location.column, on_one_line(std::move(what)), on_one_line(std::move(cure))});
}

std::vector<Problem> ProblemList::sorted() && {
  std::set<std::string> said;
  std::erase_if(problems_, [&](const Problem& problem) { return !said.insert(problem.text()).second; });
  const std::string main = on_one_line(file_);
  std::stable_sort(problems_.begin(), problems_.end(), [&](const Problem& a, const Problem& b) {
    return std::make_tuple(a.file != main, a.line, a.column) <
           std::make_tuple(b.file != main, b.line, b.column);
  });
  return std::move(problems_);
}

}  // namespace ddacontact::scene_format
