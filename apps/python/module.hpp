/// \file The parts of the extension `polydda._core`.
#pragma once

#include <pybind11/pybind11.h>

namespace polydda_python {

/// `check_text`, `run_text` and the exceptions of scenes.
void add_running(pybind11::module_& module);
/// `Frame`, `frame_list` and `read_frame`.
void add_frames(pybind11::module_& module);
/// Shape functions, element matrices, rules, meshes and `Problem`.
void add_polyfem(pybind11::module_& module);

}  // namespace polydda_python
