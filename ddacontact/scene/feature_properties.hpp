/// \file What the properties of a GeoJSON feature say about its blocks.
#pragma once

#include <ddacontact/scene/json_tree.hpp>
#include <ddacontact/scene/records.hpp>

#include <set>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// Reads `name`, `material`, `model` and `fixed`. Other properties, which exports carry many of, are passed
/// over; one that is nearly one of the four or a key of [[block]] is warned of, once in a file.
class FeatureProperties {
 public:
  explicit FeatureProperties(ProblemList& problems) : problems_(problems) {}

  /// Gives all `blocks` of a feature what it says of them; `title` names it in messages. A name or a list of
  /// vertices cannot belong to several blocks.
  void apply(const JsonValue& feature, const std::string& title, std::vector<BlockRecord>& blocks);

 private:
  void read(const JsonMember& property, const std::string& title, BlockRecord& record);
  void warn_of(const JsonMember& member, const std::string& title);
  void warn_of_outside(const JsonValue& feature, const std::string& title);
  void refuse_shared(const BlockRecord& record, const std::string& title, std::size_t n_blocks);

  ProblemList& problems_;
  std::set<std::string> judged_, judged_outside_;  ///< keys that need no second look
};

}  // namespace ddacontact::scene_format
