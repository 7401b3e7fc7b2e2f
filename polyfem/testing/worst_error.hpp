/// \file The worst of many errors, to be reported once.
#pragma once

#include <polyfem/testing/sample_polygons.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace polyfem {

/// Collects errors relative to what is allowed, with the place of the worst, and fails the running test at
/// its end when that exceeds one or is no number.
class WorstError {
 public:
  WorstError() = default;
  WorstError(const WorstError&) = delete;
  WorstError& operator=(const WorstError&) = delete;
  ~WorstError() {
    EXPECT_LE(ratio_, 1) << "error " << error_ << " where " << allowed_ << " is allowed, at x = ("
                         << x_.transpose() << ") of: " << polygon_.name << ", its vertices\n"
                         << polygon_.vertices.transpose();
    EXPECT_GT(n_seen_, 0) << "nothing was tried";
  }

  void see(double error, double allowed, const SamplePolygon& polygon, const Vec2& x) {
    ++n_seen_;
    if (error / allowed <= ratio_ || std::isnan(ratio_)) return;  // a NaN is worse than anything
    ratio_ = error / allowed;
    error_ = error;
    allowed_ = allowed;
    polygon_ = polygon;
    x_ = x;
  }

 private:
  int n_seen_ = 0;
  double ratio_ = 0, error_ = 0, allowed_ = 0;
  SamplePolygon polygon_;
  Vec2 x_ = Vec2::Zero();
};

}  // namespace polyfem
