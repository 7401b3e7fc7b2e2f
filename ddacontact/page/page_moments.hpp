/// \file Successive frames of one shape as bytes of a page.
#pragma once

#include <ddacontact/page/page_frame.hpp>
#include <ddacontact/page/page_shape.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// Frames as the page reads them, integers throughout (`append_integer`):
/// exponents of displacement (one a block), of velocity, of stress, then the table of contacts, the exponents
/// of their forces (one each) and of all gaps; then frame after frame what MomentCoder writes of
/// displacements (2 a point), velocities (2 a point), stresses (9 a cell: CellStressFit, xx yy xy at the
/// centre, change along x, along y), states and directions of contacts (2 each), their forces (2), gaps (1).
/// Arrays that the page does not hold are left out with their exponents.
std::string moments_bytes(const std::vector<PageFrame>& frames, const PageShape& shape,
                          const PageArrays& arrays);

}  // namespace ddacontact
