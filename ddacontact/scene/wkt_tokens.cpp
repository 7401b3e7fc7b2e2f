#include <ddacontact/scene/wkt_tokens.hpp>

#include <charconv>
#include <limits>

namespace ddacontact::scene_format {

namespace {

constexpr std::string_view blanks = " \t\r\n", signs = "(),;=", ends = " \t\r\n(),;=#";

}  // namespace

WktTokens::WktTokens(const std::string& text, std::shared_ptr<const std::string> source)
    : cursor_(text), source_(std::move(source)) {
  next();
}

WktToken WktTokens::take() {
  WktToken taken = std::move(token_);
  next();
  return taken;
}

bool WktTokens::take_if(std::string_view text) {
  if (!at(text)) return false;
  next();
  return true;
}

void WktTokens::expect(std::string_view text) {
  if (!take_if(text)) fail("expected '" + std::string(text) + "'");
}

void WktTokens::fail(const std::string& expected) const {
  throw WktError{token_, expected};
}

void WktTokens::next() {
  cursor_.skip_any_of(blanks);
  while (cursor_.peek() == '#') {
    cursor_.skip_until_any_of("\n");
    cursor_.skip_any_of(blanks);
  }
  token_.location = {source_, cursor_.line(), cursor_.column()};
  const std::size_t begin = cursor_.offset();
  if (!cursor_.at_end() && signs.find(cursor_.peek()) != std::string_view::npos)
    cursor_.advance();
  else
    cursor_.skip_until_any_of(ends);
  token_.text = cursor_.since(begin);
}

std::string capitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

bool is_word(const std::string& text) {
  const std::string word = capitals(text);
  return word.size() > 1 && word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos;
}

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || status == std::errc::invalid_argument) return std::nullopt;
  if (status == std::errc::result_out_of_range)
    value = text.find("e-") == std::string_view::npos && text.find("E-") == std::string_view::npos
                ? std::numeric_limits<double>::infinity()
                : 0;
  return value;
}

}  // namespace ddacontact::scene_format
