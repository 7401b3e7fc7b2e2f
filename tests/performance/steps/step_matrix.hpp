/// \file The matrix that a step solves with, made apart from the solver.
#pragma once

#include <ddacontact/time/stepper.hpp>
#include <polyfem/assembly/cholesky.hpp>

namespace step_performance {

/// The lower triangle of (13) at the end of the last step: all blocks and the springs of all contacts closed
/// then, sliding ones without that of shear.
polyfem::SparseMatrix step_matrix(ddacontact::Stepper& stepper);

}  // namespace step_performance
