/// \file Points and tensors of the libraries as NumPy arrays, one a row.
#pragma once

#include <pybind11/numpy.h>
#include <polyfem/core/types.hpp>

namespace polydda_python {

/// Rows (x, y), C-contiguous; anything that NumPy turns into one is accepted.
using PointArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A copy of an array of the shape (n, 2). Throws ValueError, with `what`, for another shape.
polyfem::Points points_of(const PointArray& array, const char* what);

/// A view of n columns of three or two entries as an array (n, 3) or (n, 2), read-only, that keeps `owner`
/// alive.
pybind11::array view(const polyfem::Points& columns, const pybind11::object& owner);
pybind11::array view(const polyfem::Tensors& columns, const pybind11::object& owner);
/// The same of numbers (n).
pybind11::array view(const polyfem::VectorXd& numbers, const pybind11::object& owner);

/// A copy as an array (n, 2).
pybind11::array copy(const polyfem::Points& columns);

}  // namespace polydda_python
