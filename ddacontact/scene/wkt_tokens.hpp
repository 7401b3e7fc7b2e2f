/// \file Words, numbers and signs of well-known text with their places.
#pragma once

#include <ddacontact/scene/problem_list.hpp>
#include <ddacontact/scene/text_cursor.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ddacontact::scene_format {

/// A word or number, a sign of its own, or with an empty text the end.
struct WktToken {
  std::string text;
  SourceLocation location;
};

/// Ends the reading of a file.
struct WktError {
  WktToken token;
  std::string expected;
};

class WktTokens {
 public:
  /// `text` must outlive it; `source` is what messages call it.
  WktTokens(const std::string& text, std::shared_ptr<const std::string> source);

  const WktToken& token() const { return token_; }
  bool at_end() const { return token_.text.empty(); }
  bool at(std::string_view text) const { return token_.text == text; }
  /// Steps over the token and returns it.
  WktToken take();
  bool take_if(std::string_view text);
  /// Throws WktError unless the token is `text`; else steps over it.
  void expect(std::string_view text);
  /// Throws WktError.
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  void next();

  TextCursor cursor_;
  std::shared_ptr<const std::string> source_;
  WktToken token_;
};

/// In capital letters.
std::string capitals(std::string text);

/// Two or more letters.
bool is_word(const std::string& text);

/// NaN and infinity too; a number beyond all doubles is infinite or 0. Nothing for other text.
std::optional<double> number_of(std::string_view text);

}  // namespace ddacontact::scene_format
