/// \file A text file read line by line, number by number; what is wrong is said with its line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace polyfem {

/// Lines that are not blank, without leading and trailing blanks.
class LineReader {
 public:
  /// \param[in] comment  starts a comment up to the end of the line; '\0': there are none
  /// Throws FileError.
  explicit LineReader(const std::filesystem::path& path, char comment = '\0');

  /// Goes on to the next line; false at the end of the file.
  bool next_line();
  /// What is left of the line.
  std::string_view rest() const { return rest_; }
  int line_number() const { return line_number_; }

  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The next number of the line. `what` names it for the message.
  double number(std::string_view what);
  /// The same for whole numbers from `least` on, below 2^31.
  int whole_number(std::string_view what, int least = 0);
  /// Goes on to the next line, which must be there: it should hold `what`.
  void require_line(std::string_view what);

  /// Throws FileError "FILE:LINE: what", of the current line or of another one.
  [[noreturn]] void fail(const std::string& what) const { fail(what, line_number_); }
  [[noreturn]] void fail(const std::string& what, int line_number) const;

 private:
  std::string_view next_word(std::string_view what);

  std::filesystem::path path_;
  std::string text_;
  char comment_;
  std::string_view unread_, rest_;
  int line_number_ = 0;
};

}  // namespace polyfem
