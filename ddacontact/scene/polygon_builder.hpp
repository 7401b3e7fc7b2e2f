/// \file The polygon of a block from the rings of a geometry file, whatever its format.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ddacontact::scene_format {

/// Collects the rings of one polygon, vertex by vertex; the first thing that is wrong with it is a problem.
class PolygonBuilder {
 public:
  /// `title` names the polygon in messages: "feature 7". `location` is its own.
  PolygonBuilder(std::string title, SourceLocation location, ProblemList& problems)
      : title_(std::move(title)), location_(std::move(location)), problems_(problems) {}

  void begin_ring(const SourceLocation& location);
  /// x and y, and a third coordinate that must be 0.
  void add_vertex(const std::vector<double>& coordinates, const SourceLocation& location);
  /// Notes what a reader found wrong itself.
  void refuse(const SourceLocation& location, const std::string& what, const std::string& cure);

  /// A block with these vertices, without the one that closes the ring; when something was wrong, with
  /// 'vertices' marked as not good.
  BlockRecord finish() &&;

 private:
  void close_ring();

  std::string title_;
  SourceLocation location_, ring_location_;
  ProblemList& problems_;
  int n_rings_ = 0;
  bool good_ = true;
  std::vector<Vec2> points_;
  Outline outline_;
};

}  // namespace ddacontact::scene_format
