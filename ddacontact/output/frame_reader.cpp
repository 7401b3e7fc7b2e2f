#include <ddacontact/output/frame_reader.hpp>

#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/io/pvd_file.hpp>
#include <polyfem/io/vtu_reader.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

using polyfem::VtuReader;
using polyfem::VtuSection;

template <class T>
T read_one(const VtuReader& file, const char* name) {
  const std::vector<T> values = file.read<T>(VtuSection::field_data, name);
  if (values.size() != 1) file.fail(std::string("array \"") + name + "\" must hold one value");
  return values[0];
}

/// The columns of `values` (`n_components` each) that belong to some points, their first two rows.
Points pick(const std::vector<double>& values, int n_components, const std::vector<int>& points) {
  const Eigen::Map<const MatrixXd> all(values.data(), n_components,
                                       static_cast<Index>(values.size()) / n_components);
  return all.topRows<2>()(Eigen::all, points);
}

/// Whether the file tells of cells: else each block is one, with Wachspress functions.
bool has_cells(const VtuReader& file) {
  return file.has(VtuSection::field_data, "n_places");
}

/// Sets the frame's blocks; returns which points of the file are theirs.
std::vector<int> read_places(const VtuReader& file, Frame& frame) {
  const auto first_point = file.read<std::int32_t>(VtuSection::field_data, "first_point");
  const auto n_vertices = file.read<std::int32_t>(VtuSection::field_data, "n_vertices");
  const auto n_points =
      has_cells(file) ? file.read<std::int32_t>(VtuSection::field_data, "n_places") : n_vertices;
  if (first_point.size() != n_vertices.size() || n_points.size() != n_vertices.size())
    file.fail("its numbers of blocks do not agree");
  const auto n_read = static_cast<std::int64_t>(file.n_points());
  std::vector<int> points;
  for (std::size_t b = 0; b < first_point.size(); ++b) {
    if (n_vertices[b] < 3 || n_points[b] < n_vertices[b] || first_point[b] < 0 ||
        first_point[b] > n_read - n_points[b] ||
        points.size() + static_cast<std::size_t>(n_points[b]) > file.n_points())
      file.fail("block " + std::to_string(b) + " has points that are not there");
    frame.blocks.push_back({static_cast<int>(points.size()), n_vertices[b]});
    for (int p = 0; p < n_points[b]; ++p) points.push_back(first_point[b] + p);
  }
  return points;
}

/// Sets the frame's cells; returns which points are their corners.
std::vector<int> read_cells(const VtuReader& file, const std::vector<int>& points, Frame& frame) {
  if (!has_cells(file)) {
    for (int b = 0; b < frame.n_blocks(); ++b) frame.add_outline_cell(b);
    return points;
  }
  const auto read = [&](const char* name) { return file.read<std::int32_t>(VtuSection::field_data, name); };
  const auto n_points = read("n_places"), block = read("cell_block"), n_corners = read("cell_n_corners"),
             elasticity = read("cell_elasticity"), is_mean_value = read("cell_is_mean_value"),
             corner_place = read("corner_place"), corner_point = read("corner_point");
  if (n_corners.size() != block.size() || elasticity.size() != block.size() ||
      is_mean_value.size() != block.size() || corner_point.size() != corner_place.size())
    file.fail("its numbers of cells do not agree");
  std::size_t corner = 0;
  for (std::size_t c = 0; c < block.size(); ++c) {
    const int least_block = c == 0 ? 0 : block[c - 1];
    if (block[c] < least_block || block[c] >= frame.n_blocks() || n_corners[c] < 3 ||
        static_cast<std::size_t>(n_corners[c]) > corner_place.size() - corner || elasticity[c] < 0 ||
        elasticity[c] >= static_cast<int>(frame.elasticity.size()))
      file.fail("cell " + std::to_string(c) + " has parts that are not there");
    const polyfem::Basis& basis =
        is_mean_value[c] != 0 ? static_cast<const polyfem::Basis&>(polyfem::mean_value) : polyfem::wachspress;
    frame.cells.push_back({block[c], {static_cast<int>(corner), n_corners[c]}, elasticity[c], &basis});
    for (const std::size_t end = corner + static_cast<std::size_t>(n_corners[c]); corner < end; ++corner) {
      if (corner_place[corner] < 0 || corner_place[corner] >= n_points[static_cast<std::size_t>(block[c])] ||
          corner_point[corner] < 0 || static_cast<std::size_t>(corner_point[corner]) >= file.n_points())
        file.fail("cell " + std::to_string(c) + " has corners that are not there");
      frame.corner_points.push_back(frame.blocks[static_cast<std::size_t>(block[c])].first +
                                    corner_place[corner]);
    }
  }
  if (corner != corner_place.size()) file.fail("it has corners of no cell");
  return corner_point;
}

void read_materials(const VtuReader& file, const std::vector<int>& points, Frame& frame) {
  const auto names = file.read<std::uint8_t>(VtuSection::field_data, "material_names");
  const auto lengths = file.read<std::int32_t>(VtuSection::field_data, "material_name_lengths");
  const auto elasticity = file.read<double>(VtuSection::field_data, "elasticity", 9);
  const auto material = file.read<std::int32_t>(VtuSection::point_data, "material");
  if (elasticity.size() < 9 * lengths.size() || elasticity.size() % 9 != 0)
    file.fail("its numbers of materials do not agree");
  std::size_t at = 0;
  for (std::size_t m = 0; m < lengths.size(); ++m) {
    const auto length = static_cast<std::size_t>(std::max(lengths[m], 0));
    if (length > names.size() - at) file.fail("its names of materials are not whole");
    frame.material_names.emplace_back(names.begin() + static_cast<std::ptrdiff_t>(at),
                                      names.begin() + static_cast<std::ptrdiff_t>(at + length));
    at += length;
  }
  for (std::size_t k = 0; k < elasticity.size(); k += 9) frame.elasticity.emplace_back(elasticity.data() + k);
  for (const Range& block : frame.blocks) {
    const int of_block = material[static_cast<std::size_t>(points[block.first])];
    if (of_block < 0 || of_block >= static_cast<int>(lengths.size())) file.fail("a block has no material");
    frame.materials.push_back(of_block);
  }
}

void read_fields(const VtuReader& file, const std::vector<int>& points, Frame& frame) {
  frame.position = pick(file.points(), 3, points);
  const auto read = [&](const char* name) {
    return file.has(VtuSection::point_data, name)
               ? pick(file.read<double>(VtuSection::point_data, name, 3), 3, points)
               : Points();
  };
  frame.displacement = read("displacement");
  frame.velocity = read("velocity");
}

void read_stress(const VtuReader& file, const std::vector<int>& corner_points, Frame& frame) {
  if (!file.has(VtuSection::point_data, "strain_displacement")) return;
  const auto w = file.read<double>(VtuSection::point_data, "strain_displacement", 2);
  frame.strain_displacement = pick(w, 2, corner_points);
  const auto mean = file.read<double>(VtuSection::field_data, "mean_stress", 3);
  if (mean.size() != 3 * frame.blocks.size()) file.fail("its mean stresses are not one a block");
  frame.mean_stress = Eigen::Map<const Tensors>(mean.data(), 3, frame.n_blocks());
  frame.stress_offset.setZero(3, frame.n_cells());
  if (!has_cells(file)) return;
  const auto offset = file.read<double>(VtuSection::field_data, "cell_stress_offset", 3);
  if (offset.size() != 3 * frame.cells.size()) file.fail("its stress offsets are not one a cell");
  frame.stress_offset = Eigen::Map<const Tensors>(offset.data(), 3, frame.n_cells());
}

void read_block_values(const VtuReader& file, Frame& frame) {
  for (const BlockField& field : block_fields()) {
    if (!file.has(VtuSection::cell_data, field.name)) continue;
    const auto block = file.read<std::int32_t>(VtuSection::cell_data, "block_id");
    const auto of_cells = file.read<double>(VtuSection::cell_data, field.name);
    VectorXd& values = frame.block_values[field.name];
    values.setZero(frame.n_blocks());
    for (std::size_t c = 0; c < of_cells.size(); ++c) {
      if (block[c] < 0 || block[c] >= frame.n_blocks()) file.fail("a cell has a block that does not exist");
      values[block[c]] = of_cells[c];
    }
  }
}

ContactState state_of(const VtuReader& file, int state, int slip_sense) {
  for (ContactState candidate : {ContactState::open, ContactState::stick})
    if (state == static_cast<int>(candidate) && slip_sense == 0) return candidate;
  if (state == 2 && slip_sense == 1) return ContactState::slip_forward;
  if (state == 2 && slip_sense == -1) return ContactState::slip_backward;
  file.fail("a contact has a state that does not exist");
}

void read_contacts(const VtuReader& file, Frame& frame) {
  const auto numbers = [&](const char* name, int n_components = 1) {
    return file.read<double>(VtuSection::point_data, name, n_components);
  };
  const auto integers = [&](const char* name) {
    return file.read<std::int32_t>(VtuSection::point_data, name);
  };
  const auto points = file.points(), normal = numbers("normal", 3), gap = numbers("gap"),
             normal_force = numbers("normal_force"), shear_force = numbers("shear_force");
  const auto state = integers("state"), slip_sense = integers("slip_sense"), block_a = integers("block_a"),
             block_b = integers("block_b");
  const auto is_block = [&](int b) { return b >= 0 && b < frame.n_blocks(); };
  for (std::size_t k = 0; k < file.n_points(); ++k) {
    if (!is_block(block_a[k]) || !is_block(block_b[k]))
      file.fail("a contact has a block that does not exist");
    frame.contacts.push_back({.vertex_block = block_a[k],
                              .edge_block = block_b[k],
                              .position = Vec2(points[3 * k], points[3 * k + 1]),
                              .normal = Vec2(normal[3 * k], normal[3 * k + 1]),
                              .gap = gap[k],
                              .normal_force = normal_force[k],
                              .shear_force = shear_force[k],
                              .state = state_of(file, state[k], slip_sense[k])});
  }
}

std::vector<polyfem::PvdEntry> entries_of(const std::filesystem::path& directory, const char* series) {
  if (!std::filesystem::exists(directory))
    throw polyfem::FileError("there is no directory \"" + directory.string() + "\"");
  if (!std::filesystem::exists(directory / series))
    throw polyfem::FileError("\"" + directory.string() + "\" is not a result directory: it has no \"" +
                             series + "\"");
  return polyfem::read_pvd(directory / series);
}

}  // namespace

FrameSeries read_series(const std::filesystem::path& directory) {
  const std::vector<polyfem::PvdEntry> blocks = entries_of(directory, "results.pvd"),
                                       contacts = entries_of(directory, "contacts.pvd");
  if (blocks.empty()) throw polyfem::FileError("\"" + directory.string() + "\" has no frames yet");
  FrameSeries series;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (k >= contacts.size() || contacts[k].time != blocks[k].time)
      throw polyfem::FileError("\"" + (directory / "contacts.pvd").string() +
                               "\" does not list the moments that results.pvd lists");
    series.push_back(
        {blocks[k].step, blocks[k].time, directory / blocks[k].file, directory / contacts[k].file});
  }
  return series;
}

Frame read_frame(const FrameFile& files) {
  const VtuReader blocks(files.blocks), contacts(files.contacts);
  Frame frame;
  frame.time = read_one<double>(blocks, "TimeValue");
  frame.step = read_one<std::int64_t>(blocks, "step");
  const std::vector<int> points = read_places(blocks, frame);
  read_materials(blocks, points, frame);
  read_fields(blocks, points, frame);
  read_stress(blocks, read_cells(blocks, points, frame), frame);
  read_block_values(blocks, frame);
  if (read_one<double>(contacts, "TimeValue") != frame.time) contacts.fail("it is of another moment");
  read_contacts(contacts, frame);
  return frame;
}

}  // namespace ddacontact
