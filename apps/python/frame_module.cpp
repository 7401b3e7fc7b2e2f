#include "array_views.hpp"
#include "module.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ddacontact/output/frame_reader.hpp>

#include <memory>
#include <mutex>

namespace polydda_python {

namespace py = pybind11;
using namespace ddacontact;

namespace {

/// A row of Frame.contacts.
struct ContactRow {
  int vertex_block, edge_block, state;
  double x, y, normal_x, normal_y, gap, normal_force, shear_force;
};

/// Tells NumPy of the row when the first one is wanted: importing the module need not import NumPy. A thread
/// that waits here must not hold the interpreter, which the import may hand to another.
void register_contact_row() {
  static std::once_flag once;
  const py::gil_scoped_release others_go_on;
  std::call_once(once, [] {
    const py::gil_scoped_acquire interpreter;
    PYBIND11_NUMPY_DTYPE(ContactRow, vertex_block, edge_block, state, x, y, normal_x, normal_y, gap,
                         normal_force, shear_force);
  });
}

py::array contacts_of(const Frame& frame) {
  register_contact_row();
  py::array_t<ContactRow> rows(static_cast<py::ssize_t>(frame.contacts.size()));
  ContactRow* row = rows.mutable_data();
  for (const FrameContact& c : frame.contacts)
    *row++ = {c.vertex_block, c.edge_block,   static_cast<int>(c.state),
              c.position.x(), c.position.y(), c.normal.x(),
              c.normal.y(),   c.gap,          c.normal_force,
              c.shear_force};
  return rows;
}

/// The outline of each block that is present, a view of the frame's positions.
py::list outlines_of(const py::object& self) {
  const Frame& frame = self.cast<const Frame&>();
  const py::array positions = view(frame.position, self);
  py::list outlines;
  for (const int b : frame.present_blocks()) {
    const Range& range = frame.blocks[b];
    outlines.append(positions[py::slice(range.first, range.first + range.count, 1)]);
  }
  return outlines;
}

/// First point and number of points of the same outlines.
py::list outline_ranges_of(const Frame& frame) {
  py::list ranges;
  for (const int b : frame.present_blocks())
    ranges.append(py::make_tuple(frame.blocks[b].first, frame.blocks[b].count));
  return ranges;
}

py::dict block_values_of(const py::object& self) {
  py::dict arrays;
  for (const auto& [name, values] : self.cast<const Frame&>().block_values)
    arrays[py::str(name)] = view(values, self);
  return arrays;
}

template <auto member>
py::array view_of(const py::object& self) {
  return view(self.cast<const Frame&>().*member, self);
}

}  // namespace

void add_frames(py::module_& module) {
  py::class_<Frame, std::shared_ptr<Frame>>(module, "Frame",
                                            "One moment of a run; arrays are read-only views.")
      .def_readonly("step", &Frame::step, "Number of the step that it was written after.")
      .def_readonly("time", &Frame::time, "s")
      .def_property_readonly("present", &Frame::present_blocks, "Indices of the blocks in `outlines`.")
      .def_property_readonly("outlines", &outlines_of, "Vertices (n, 2) of each block that is present, m.")
      .def_property_readonly("outline_ranges", &outline_ranges_of,
                             "First place and number of places of each of `outlines`.")
      .def_property_readonly("position", &view_of<&Frame::position>, "Of all points (n, 2), m.")
      .def_property_readonly("displacement", &view_of<&Frame::displacement>, "Of all points (n, 2), m.")
      .def_property_readonly("velocity", &view_of<&Frame::velocity>, "Of all points (n, 2), m/s.")
      .def_property_readonly("stress", &view_of<&Frame::mean_stress>,
                             "Mean sxx, syy, sxy of every block (n, 3), Pa, tension positive.")
      .def_property_readonly("block_values", &block_values_of,
                             "Numbers of every block (n) by name, as `dda plot --field` takes it.")
      .def_property_readonly("contacts", &contacts_of, "Closed contacts, a structured array.");
  py::dict units;
  for (const BlockField& field : block_fields()) units[field.name] = field.unit;
  module.attr("block_fields") = units;
  module.def(
      "frame_list",
      [](const std::filesystem::path& directory) {
        py::list frames;
        for (const FrameFile& file : read_series(directory))
          frames.append(py::make_tuple(file.step, file.time));
        return frames;
      },
      py::arg("directory"), "(step, time) of each frame of a result directory.");
  module.def(
      "read_frame",
      [](const std::filesystem::path& directory, std::size_t k) {
        return std::make_shared<Frame>(read_frame(read_series(directory).at(k)));
      },
      py::arg("directory"), py::arg("k"), "The frame of that index of `frame_list`.");
}

}  // namespace polydda_python
