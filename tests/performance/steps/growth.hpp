/// \file How a quantity grows with size.
#pragma once

#include <span>

namespace step_performance {

/// The p of y ~ x^p: the slope of the line nearest to all points in logarithms. NaN for less than two points.
double growth_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace step_performance
