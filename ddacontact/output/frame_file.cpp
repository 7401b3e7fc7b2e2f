#include <ddacontact/output/frame_file.hpp>

#include <ddacontact/output/frame_mesh.hpp>
#include <polyfem/basis/mean_value.hpp>

#include <numeric>

namespace ddacontact {

namespace {

using polyfem::VtuFile;
using polyfem::VtuSection;

/// A matrix's entries, column after column.
template <class Matrix>
std::span<const double> entries(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

void add_time(VtuFile& file, const Frame& frame) {
  const std::int64_t step = frame.step;
  file.add(VtuSection::field_data, "TimeValue", std::span(&frame.time, 1));
  file.add(VtuSection::field_data, "step", std::span(&step, 1));
}

/// What the frame holds beside values at points.
void add_field_data(VtuFile& file, const Frame& frame, const FrameMesh& mesh) {
  std::vector<std::int32_t> n_vertices, name_lengths;
  for (const Range& block : frame.blocks) n_vertices.push_back(block.count);
  std::vector<std::uint8_t> names;
  for (const std::string& name : frame.material_names) {
    names.insert(names.end(), name.begin(), name.end());
    name_lengths.push_back(static_cast<std::int32_t>(name.size()));
  }
  std::vector<double> elasticity;
  for (const Mat3& D : frame.elasticity) elasticity.insert(elasticity.end(), D.data(), D.data() + D.size());
  file.add(VtuSection::field_data, "first_point", mesh.first_point);
  file.add(VtuSection::field_data, "n_vertices", n_vertices);
  file.add(VtuSection::field_data, "material_names", names);
  file.add(VtuSection::field_data, "material_name_lengths", name_lengths);
  file.add(VtuSection::field_data, "elasticity", elasticity, 9);
  if (frame.mean_stress.cols() > 0)
    file.add(VtuSection::field_data, "mean_stress", entries(frame.mean_stress), 3);
}

/// What makes the cells, where they are not the outlines.
void add_cells(VtuFile& file, const Frame& frame, const FrameMesh& mesh) {
  std::vector<std::int32_t> n_points, block, n_corners, elasticity, is_mean_value, corner_place;
  for (int b = 0; b < frame.n_blocks(); ++b) n_points.push_back(frame.points(b).count);
  for (const FrameCell& cell : frame.cells) {
    block.push_back(cell.block);
    n_corners.push_back(cell.corners.count);
    elasticity.push_back(cell.elasticity);
    is_mean_value.push_back(cell.basis == &polyfem::mean_value);
    for (int k = 0; k < cell.corners.count; ++k)
      corner_place.push_back(frame.corner_points[cell.corners.first + k] - frame.blocks[cell.block].first);
  }
  file.add(VtuSection::field_data, "n_places", n_points);
  file.add(VtuSection::field_data, "cell_block", block);
  file.add(VtuSection::field_data, "cell_n_corners", n_corners);
  file.add(VtuSection::field_data, "cell_elasticity", elasticity);
  file.add(VtuSection::field_data, "cell_is_mean_value", is_mean_value);
  file.add(VtuSection::field_data, "corner_place", corner_place);
  file.add(VtuSection::field_data, "corner_point", mesh.corner_point);
  if (frame.stress_offset.cols() > 0)
    file.add(VtuSection::field_data, "cell_stress_offset", entries(frame.stress_offset), 3);
}

void add_values(VtuFile& file, VtuSection section, const std::vector<int>& block_of,
                const FrameValues& values, const Frame& frame, const FrameOptions& options) {
  std::vector<std::int32_t> material;
  material.reserve(block_of.size());
  for (int block : block_of) material.push_back(frame.materials[block]);
  file.add(section, "block_id", block_of);
  file.add(section, "material", material);
  if (options.displacement) file.add(section, "displacement", entries(values.displacement), 3);
  if (options.velocity) file.add(section, "velocity", entries(values.velocity), 3);
  if (options.stress) {
    file.add(section, "sxx", entries(values.stress.col(0)));
    file.add(section, "syy", entries(values.stress.col(1)));
    file.add(section, "sxy", entries(values.stress.col(2)));
  }
  if (options.principal) {
    const Eigen::MatrixX2d principal = values.principal_stresses();
    file.add(section, "s1", entries(principal.col(0)));
    file.add(section, "s2", entries(principal.col(1)));
  }
}

void add_block_values(VtuFile& file, const std::vector<int>& block_of_cell, const Frame& frame) {
  for (const auto& [name, values] : frame.block_values)
    file.add(VtuSection::cell_data, name, entries(VectorXd(values(block_of_cell))));
}

int state_number(ContactState state) {
  return state == ContactState::open ? 0 : state == ContactState::stick ? 1 : 2;
}

}  // namespace

void write_blocks(const std::filesystem::path& path, const Frame& frame, const FrameOptions& options) {
  const FrameMesh mesh = options.refine == 0 ? draw_cells(frame) : draw_sub_triangles(frame, options.refine);
  VtuFile file(options.n_threads);
  add_time(file, frame);
  add_field_data(file, frame, mesh);
  if (!frame.has_outline_cells_only()) add_cells(file, frame, mesh);
  file.set_points(entries(mesh.points));
  file.set_cells(mesh.connectivity, mesh.ends, mesh.cell_types);
  add_values(file, VtuSection::point_data, mesh.block_of_point, mesh.at_points, frame, options);
  add_values(file, VtuSection::cell_data, mesh.block_of_cell, mesh.at_cells, frame, options);
  add_block_values(file, mesh.block_of_cell, frame);
  if (mesh.at_points.strain_displacement.cols() > 0)
    file.add(VtuSection::point_data, "strain_displacement", entries(mesh.at_points.strain_displacement), 2);
  file.write(path);
}

void write_contacts(const std::filesystem::path& path, const Frame& frame) {
  const Index n = static_cast<Index>(frame.contacts.size());
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, n), force = points, normal = points;
  VectorXd normal_force(n), shear_force(n), gap(n);
  std::vector<std::int32_t> state, slip_sense, block_a, block_b;
  for (Index k = 0; k < n; ++k) {
    const FrameContact& contact = frame.contacts[k];
    points.col(k).head<2>() = contact.position;
    force.col(k).head<2>() = contact.force();
    normal.col(k).head<2>() = contact.normal;
    normal_force[k] = contact.normal_force;
    shear_force[k] = contact.shear_force;
    gap[k] = contact.gap;
    state.push_back(state_number(contact.state));
    slip_sense.push_back(static_cast<int>(slip_sign(contact.state)));
    block_a.push_back(contact.vertex_block);
    block_b.push_back(contact.edge_block);
  }
  std::vector<std::int64_t> connectivity(frame.contacts.size()), ends(frame.contacts.size());
  std::iota(connectivity.begin(), connectivity.end(), 0);
  std::iota(ends.begin(), ends.end(), 1);

  VtuFile file;
  add_time(file, frame);
  file.set_points(entries(points));
  file.set_cells(connectivity, ends, std::vector(frame.contacts.size(), polyfem::VtkCell::vertex));
  file.add(VtuSection::point_data, "normal_force", entries(normal_force));
  file.add(VtuSection::point_data, "shear_force", entries(shear_force));
  file.add(VtuSection::point_data, "gap", entries(gap));
  file.add(VtuSection::point_data, "state", state);
  file.add(VtuSection::point_data, "slip_sense", slip_sense);
  file.add(VtuSection::point_data, "force", entries(force), 3);
  file.add(VtuSection::point_data, "normal", entries(normal), 3);
  file.add(VtuSection::point_data, "block_a", block_a);
  file.add(VtuSection::point_data, "block_b", block_b);
  file.write(path);
}

}  // namespace ddacontact
