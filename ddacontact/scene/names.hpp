/// \file Names of blocks, materials, ... and the indices they stand for.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ddacontact::scene_format {

class NameTable {
 public:
  /// `kind` is what messages call its members: "block".
  explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

  /// The next member. One that is empty, taken or holds control characters is a problem.
  /// `origin`, where not empty, follows its title in messages: "block 3 of feature 7".
  void add(const std::optional<std::string>& name, const KeyLocations& locations, ProblemList& problems,
           const std::string& origin = {});

  /// Some members are not known: from now on one that is not found is no problem.
  void set_incomplete() { incomplete_ = true; }

  bool knows(const std::string& name) const { return indices_.contains(name); }

  /// The index of a member called by name, by index, or by its index as a string when no one has that name;
  /// -1 and a problem at `location` when there is none. `asked_by`, where not empty, is told in the
  /// problem: "feature 7".
  int find(const Reference& reference, const SourceLocation& location, ProblemList& problems,
           const std::string& asked_by = {}) const;

  /// Warns of names that are the index of a member without a name: results would call two members the same.
  void warn_of_ambiguous_names(ProblemList& problems) const;

  int size() const { return static_cast<int>(names_.size()); }
  /// The name in quotes, or the index, and the origin: "block 'slider'", "block 3 of feature 7".
  std::string title(int index) const;

 private:
  std::string kind_;
  std::vector<std::string> names_, origins_;                  ///< origins as " of feature 7"
  std::vector<std::pair<int, SourceLocation>> number_names_;  ///< members whose name is a number
  std::unordered_map<std::string, int> indices_;
  bool incomplete_ = false;
};

}  // namespace ddacontact::scene_format
