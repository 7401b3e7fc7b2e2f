/// \file Problems of one scene as they are found, to be handed out in the order of the file.
#pragma once

#include <ddacontact/scene/problem.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ddacontact::scene_format {

/// Where something stands: a line and a column (both from 1) of the scene file, a geometry file or a setting.
struct SourceLocation {
  std::shared_ptr<const std::string> source;  ///< the other file or the setting; none: the scene file
  int line = 1, column = 1;
};

class ProblemList {
 public:
  /// `file` is the scene's name in the messages.
  explicit ProblemList(std::string file) : file_(std::move(file)) {}

  void error(const SourceLocation& location, std::string what, std::string cure);
  void warning(const SourceLocation& location, std::string what, std::string cure);

  /// Whether an unknown name may be compared with all known ones: a hundred times, which keeps a large bad
  /// scene from taking minutes. Counts each call.
  bool may_suggest() { return n_suggestions_++ < 100; }

  const std::string& file() const { return file_; }
  std::size_t size() const { return problems_.size(); }
  /// Notes a value that is missing for a reason told before: an unknown parameter.
  void note_missing_value() { ++n_missing_values_; }
  /// Grows where something that was read is not to be used.
  std::size_t n_faults() const { return problems_.size() + n_missing_values_; }
  bool has_errors() const { return ddacontact::has_errors(problems_); }

  /// Those of the scene file by line and column, then those of settings as they were given, then those of a
  /// geometry file by line and column. Control characters and line ends inside a message are shown as spaces:
  /// one problem is one line, and what is found twice stands once.
  std::vector<Problem> sorted() &&;

 private:
  void add(Problem::Severity severity, const SourceLocation& location, std::string what, std::string cure);

  std::string file_;
  std::vector<Problem> problems_;
  std::size_t n_missing_values_ = 0;
  int n_suggestions_ = 0;
};

}  // namespace ddacontact::scene_format
