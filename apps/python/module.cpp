/// \file The extension `polydda._core`, on which the package's Python files stand.
#include "module.hpp"

#include <ddacontact/output/output_error.hpp>
#include <polyfem/core/error.hpp>

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  module.doc() = "The libraries polyfem and ddacontact; use the package polydda.";
  module.attr("__version__") = POLYDDA_VERSION;
  py::register_exception<polyfem::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "The request cannot be carried out; the message says why, and what to write instead.";
  py::register_exception<ddacontact::OutputError>(module, "OutputError", PyExc_OSError).attr("__doc__") =
      "A result file cannot be read or written.";
  polydda_python::add_running(module);
  polydda_python::add_frames(module);
  polydda_python::add_polyfem(module);
}
