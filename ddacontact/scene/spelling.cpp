#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <array>

namespace ddacontact::scene_format {

namespace {

constexpr std::size_t longest_word = 64;
constexpr std::size_t longest_list = 16;
constexpr std::size_t longest_excerpt = 40;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, longest_word);
  b = b.substr(0, longest_word);
  std::array<int, longest_word + 1> before_last{}, last{}, row{};
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char p = lower(a[i - 1]), q = lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (p == q ? 0 : 1)});
      if (i > 1 && j > 1 && p == lower(b[j - 2]) && q == lower(a[i - 2]))
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

namespace {

bool contains(std::string_view text, std::string_view part) {
  return part.size() >= 3 && text.find(part) != std::string_view::npos;
}

/// Edits, but at most two when one word is a part of the other.
int distance(std::string_view word, std::string_view known) {
  const int edits = edit_distance(word, known);
  return contains(word, known) || contains(known, word) ? std::min(edits, 2) : edits;
}

}  // namespace

int nearest(std::string_view word, const std::vector<std::string_view>& known) {
  int best = -1, fewest = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const int edits = distance(word, known[i]);
    if (best < 0 || edits < fewest) {
      best = static_cast<int>(i);
      fewest = edits;
    }
  }
  return best;
}

bool is_near(std::string_view word, std::string_view known) {
  return distance(word, known) <= static_cast<int>(std::max<std::size_t>(2, word.size() / 3));
}

std::string suggestion(std::string_view word, std::string_view kind,
                       const std::vector<std::string_view>& known) {
  const int best = nearest(word, known);
  if (best < 0) return "there is no " + std::string(kind);
  const std::string name = excerpt(known[best]);
  if (is_near(word, known[best])) return "did you mean '" + name + "'?";
  std::string text = "the nearest known " + std::string(kind) + " is '" + name + "'";
  if (known.size() > 1 && known.size() <= longest_list) {
    text += "; known:";
    for (std::size_t i = 0; i < known.size(); ++i) text += (i == 0 ? " " : ", ") + excerpt(known[i]);
  }
  return text;
}

std::string excerpt(std::string_view text) {
  if (text.size() <= longest_excerpt) return std::string(text);
  std::size_t length = longest_excerpt;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
  return std::string(text.substr(0, length)) + "...";
}

}  // namespace ddacontact::scene_format
