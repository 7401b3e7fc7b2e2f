/// \file What `dda info` answers, line by line.
#pragma once

#include <fmt/format.h>

#include <string>

namespace dda {

/// Lines of the answer; a topic's further lines stand below its first.
class Answer {
 public:
  void topic(const std::string& name) { topic_ = name; }
  void line(const std::string& text) {
    text_ += fmt::format("  {:<11} {}\n", topic_, text);
    topic_.clear();
  }
  void heading(const std::string& text) { text_ += text + "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_, topic_;
};

/// "1 step", "2 steps".
inline std::string plural(double count, const std::string& one, const std::string& many) {
  return fmt::format("{:.0f} {}", count, count == 1 ? one : many);
}

}  // namespace dda
