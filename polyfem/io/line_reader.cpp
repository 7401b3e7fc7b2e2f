#include <polyfem/io/line_reader.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/text_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace polyfem {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

template <class T>
bool parse(std::string_view word, T& value) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;  // out of range: the value is as it was
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path, char comment)
    : path_(path), text_(read_text(path)), comment_(comment), unread_(text_) {}

bool LineReader::next_line() {
  while (!unread_.empty()) {
    const std::size_t end = unread_.find('\n');
    std::string_view line = unread_.substr(0, end);
    unread_.remove_prefix(end == std::string_view::npos ? unread_.size() : end + 1);
    ++line_number_;
    if (comment_ != '\0') line = line.substr(0, line.find(comment_));
    rest_ = trimmed(line);
    if (!rest_.empty()) return true;
  }
  return false;
}

std::string_view LineReader::word() {
  const std::size_t end = rest_.find_first_of(blanks);
  const std::string_view word = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : trimmed(rest_.substr(end));
  return word;
}

void LineReader::require_line(std::string_view what) {
  if (!next_line())
    fail("the file ends where " + std::string(what) + " should follow: it is cut short; write it again");
}

std::string_view LineReader::next_word(std::string_view what) {
  if (rest_.empty()) fail("the line ends too early: give " + std::string(what));
  return word();
}

double LineReader::number(std::string_view what) {
  const std::string_view text = next_word(what);
  double value = 0;
  if (!parse(text, value) || !std::isfinite(value))
    fail("\"" + std::string(text) + "\" is no finite number: give " + std::string(what));
  return value;
}

int LineReader::whole_number(std::string_view what, int least) {
  const std::string_view text = next_word(what);
  int value = 0;
  if (!parse(text, value) || value < least)
    fail("\"" + std::string(text) + "\" is no whole number of at least " + std::to_string(least) + ": give " +
         std::string(what));
  return value;
}

void LineReader::fail(const std::string& what, int line_number) const {
  throw FileError(path_.string() + ":" + std::to_string(std::max(line_number, 1)) + ": " + what);
}

}  // namespace polyfem
