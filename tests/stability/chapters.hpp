/// \file The rows of doc/verification/stability.md.
#pragma once

#include "page.hpp"

namespace stability {

void moving(Page& page);
void scaling(Page& page);
void turning(Page& page);
void hard_shapes(Page& page);
void ratios(Page& page);
void incompressible(Page& page);
void time_steps(Page& page);
void spinning(Page& page);
void resting(Page& page);
void slope(Page& page);
void momentum(Page& page);
void contact_forces(Page& page);
void drops(Page& page);
void overlaps(Page& page);
void concave_corners(Page& page);
void threads(Page& page);
void interruptions(Page& page);

}  // namespace stability
