/// \file The examples of the paper's section 5, each a chapter.
#pragma once

#include "report.hpp"

namespace verification {

void sliding_block(Report& report);  // 5.1
void arch_bridge(Report& report);    // 5.2
void voronoi_slope(Report& report);  // 5.3

}  // namespace verification
