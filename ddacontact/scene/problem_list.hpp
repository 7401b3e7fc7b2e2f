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

  const std::string& file() const { return file_; }
  std::size_t size() const { return problems_.size(); }
  bool has_errors() const { return ddacontact::has_errors(problems_); }

  /// Those of the scene file by line and column, then those of settings as they were given, then those of a
  /// geometry file by line and column. Control characters and line ends inside a message are shown as spaces:
  /// one problem is one line, and what is found twice stands once.
  std::vector<Problem> sorted() &&;

 private:
  void add(Problem::Severity severity, const SourceLocation& location, std::string what, std::string cure);

  std::string file_;
  std::vector<Problem> problems_;
};

}  // namespace ddacontact::scene_format
