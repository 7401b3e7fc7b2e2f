#include "array_views.hpp"

#include <string>

namespace polydda_python {

namespace py = pybind11;
using polyfem::Index;

namespace {

py::array read_only(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <class Columns>
py::array view_of(const Columns& columns, const py::object& owner) {
  const py::ssize_t n_entries = columns.rows(), size = sizeof(double);
  return read_only(py::array_t<double>({static_cast<py::ssize_t>(columns.cols()), n_entries},
                                       {n_entries * size, size}, columns.data(), owner));
}

}  // namespace

polyfem::Points points_of(const PointArray& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 2)
    throw py::value_error(std::string(what) + " must be an array of the shape (n, 2)");
  return Eigen::Map<const polyfem::Points>(array.data(), 2, static_cast<Index>(array.shape(0)));
}

py::array view(const polyfem::Points& columns, const py::object& owner) {
  return view_of(columns, owner);
}

py::array view(const polyfem::Tensors& columns, const py::object& owner) {
  return view_of(columns, owner);
}

py::array view(const polyfem::VectorXd& numbers, const py::object& owner) {
  return read_only(py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data(), owner));
}

py::array copy(const polyfem::Points& columns) {
  py::array_t<double> array({static_cast<py::ssize_t>(columns.cols()), py::ssize_t{2}});
  std::copy(columns.data(), columns.data() + columns.size(), array.mutable_data());
  return array;
}

}  // namespace polydda_python
