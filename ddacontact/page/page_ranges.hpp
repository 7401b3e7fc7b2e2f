/// \file Ranges of fields over a whole run, for colours that single peaks do not spoil.
#pragma once

#include <ddacontact/page/page_frame.hpp>
#include <ddacontact/picture/colour_scale.hpp>

#include <map>
#include <vector>

namespace ddacontact {

/// Of a field over some frames.
struct PageRange {
  ValueRange all;     ///< smallest and largest value
  ValueRange robust;  ///< 1st and 99th percentile of each frame, the widest over the frames
};

/// The ranges of the fields that a page shows, frame after frame.
class PageRanges {
 public:
  void see(const PageFrame& shown, const PageArrays& arrays);
  const std::map<Field, PageRange>& of_fields() const { return of_fields_; }
  /// The 99th percentile of contact forces, the largest over the frames, N per m.
  double force() const { return force_; }

 private:
  void see(Field field, std::vector<double> values);

  std::map<Field, PageRange> of_fields_;
  double force_ = 0;
};

/// Linear between the sorted values; `fraction` 0 is the smallest, 1 the largest.
double percentile(std::vector<double> values, double fraction);

}  // namespace ddacontact
