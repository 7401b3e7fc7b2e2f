/// \file A place in a text that moves forward and knows its line and column.
#pragma once

#include <cstddef>
#include <string_view>

namespace ddacontact::scene_format {

/// Lines and columns count from 1, columns in UTF-8 characters; a byte order mark is passed over.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : text_(text) {
    if (text.substr(0, 3) == "\xef\xbb\xbf") offset_ = 3;
  }

  bool at_end() const { return offset_ >= text_.size(); }
  /// The byte here; 0 at the end.
  char peek() const { return at_end() ? '\0' : text_[offset_]; }
  std::size_t offset() const { return offset_; }
  int line() const { return line_; }
  int column() const { return column_; }

  void advance() {
    const char c = text_[offset_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {
      ++column_;
    }
  }
  void advance_to(std::size_t offset) {
    while (offset_ < offset && !at_end()) advance();
  }
  void skip_any_of(std::string_view set) {
    while (!at_end() && set.find(text_[offset_]) != std::string_view::npos) advance();
  }
  void skip_until_any_of(std::string_view set) {
    while (!at_end() && set.find(text_[offset_]) == std::string_view::npos) advance();
  }
  /// The text from `offset` to here.
  std::string_view since(std::size_t offset) const { return text_.substr(offset, offset_ - offset); }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  int line_ = 1, column_ = 1;
};

}  // namespace ddacontact::scene_format
