#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/polygon_builder.hpp>
#include <ddacontact/scene/text.hpp>

#include <cmath>

namespace ddacontact::scene_format {

void PolygonBuilder::refuse(const SourceLocation& location, const std::string& what,
                            const std::string& cure) {
  if (good_) problems_.error(location, title_ + ' ' + what, cure);
  good_ = false;
}

void PolygonBuilder::begin_ring(const SourceLocation& location) {
  if (++n_rings_ == 1)
    ring_location_ = location;
  else
    refuse(location, "has a hole", "a block has no holes: split it into blocks around the hole");
}

void PolygonBuilder::add_vertex(const std::vector<double>& coordinates, const SourceLocation& location) {
  if (n_rings_ != 1 || !good_) return;
  const std::string vertex = "vertex " + std::to_string(points_.size());
  if (coordinates.size() < 2 || coordinates.size() > 3)
    return refuse(location,
                  "has at " + vertex + " not two coordinates but " + std::to_string(coordinates.size()),
                  "write x and y in m");
  for (const double value : coordinates) {
    if (!std::isfinite(value) || std::abs(value) > largest_number)
      return refuse(location,
                    "has at " + vertex + " the coordinate '" + short_number(value) + "', which is " +
                        (std::isfinite(value) ? "too large" : "not a finite number"),
                    "expected a number in m");
  }
  if (coordinates.size() == 3 && coordinates[2] != 0)
    return refuse(location,
                  "has at " + vertex + " the third coordinate '" + short_number(coordinates[2]) + "'",
                  "geometry is two-dimensional: a third coordinate must be 0");
  points_.emplace_back(coordinates[0], coordinates[1]);
  outline_.locations.push_back(location);
}

void PolygonBuilder::close_ring() {
  if (points_.empty())
    return refuse(n_rings_ == 0 ? location_ : ring_location_, "is empty",
                  "leave it out, or give it vertices");
  if (points_.size() < 2 || points_.front() != points_.back())
    return refuse(outline_.locations.back(), "has a ring that is not closed",
                  "end it with its first vertex, to the last digit");
  points_.pop_back();
  outline_.locations.pop_back();
}

BlockRecord PolygonBuilder::finish() && {
  if (good_) close_ring();
  BlockRecord record;
  record.origin = title_;
  record.locations.table = location_;
  record.locations.add("vertices", location_, good_);
  if (!good_) return record;
  outline_.points.resize(2, static_cast<polyfem::Index>(points_.size()));
  for (std::size_t k = 0; k < points_.size(); ++k)
    outline_.points.col(static_cast<polyfem::Index>(k)) = points_[k];
  record.vertices = std::move(outline_);
  return record;
}

}  // namespace ddacontact::scene_format
