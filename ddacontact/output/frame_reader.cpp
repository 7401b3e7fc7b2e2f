#include <ddacontact/output/frame_reader.hpp>

#include <polyfem/io/pvd_file.hpp>
#include <polyfem/io/vtu_reader.hpp>

#include <algorithm>
#include <numeric>

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

/// The columns of `values` (`n_components` each) that are vertices of outlines, their first two rows.
Points pick_vertices(const std::vector<double>& values, int n_components, const std::vector<int>& vertices) {
  const Eigen::Map<const MatrixXd> all(values.data(), n_components,
                                       static_cast<Index>(values.size()) / n_components);
  return all.topRows<2>()(Eigen::all, vertices);
}

/// Sets the frame's blocks; returns which points are their vertices.
std::vector<int> read_outlines(const VtuReader& file, Frame& frame) {
  const auto first_point = file.read<std::int32_t>(VtuSection::field_data, "first_point");
  const auto n_vertices = file.read<std::int32_t>(VtuSection::field_data, "n_vertices");
  if (first_point.size() != n_vertices.size()) file.fail("its numbers of blocks do not agree");
  const auto n_points = static_cast<std::int64_t>(file.n_points());
  std::vector<int> vertices;
  for (std::size_t b = 0; b < first_point.size(); ++b) {
    if (n_vertices[b] < 3 || first_point[b] < 0 || first_point[b] > n_points - n_vertices[b] ||
        vertices.size() + static_cast<std::size_t>(n_vertices[b]) > file.n_points())
      file.fail("block " + std::to_string(b) + " has points that are not there");
    frame.blocks.push_back({static_cast<int>(vertices.size()), n_vertices[b]});
    for (int v = 0; v < n_vertices[b]; ++v) vertices.push_back(first_point[b] + v);
  }
  return vertices;
}

void read_materials(const VtuReader& file, const std::vector<int>& vertices, Frame& frame) {
  const auto names = file.read<std::uint8_t>(VtuSection::field_data, "material_names");
  const auto lengths = file.read<std::int32_t>(VtuSection::field_data, "material_name_lengths");
  const auto elasticity = file.read<double>(VtuSection::field_data, "elasticity", 9);
  const auto material = file.read<std::int32_t>(VtuSection::point_data, "material");
  if (elasticity.size() != 9 * lengths.size()) file.fail("its numbers of materials do not agree");
  std::size_t at = 0;
  for (std::size_t m = 0; m < lengths.size(); ++m) {
    const auto length = static_cast<std::size_t>(std::max(lengths[m], 0));
    if (length > names.size() - at) file.fail("its names of materials are not whole");
    frame.material_names.emplace_back(names.begin() + static_cast<std::ptrdiff_t>(at),
                                      names.begin() + static_cast<std::ptrdiff_t>(at + length));
    frame.elasticity.emplace_back(elasticity.data() + 9 * m);
    at += length;
  }
  for (const Range& block : frame.blocks) {
    const int of_block = material[static_cast<std::size_t>(vertices[block.first])];
    if (of_block < 0 || of_block >= static_cast<int>(lengths.size())) file.fail("a block has no material");
    frame.materials.push_back(of_block);
  }
}

void read_fields(const VtuReader& file, const std::vector<int>& vertices, Frame& frame) {
  frame.position = pick_vertices(file.points(), 3, vertices);
  const auto read = [&](const char* name, int n_components) {
    return file.has(VtuSection::point_data, name)
               ? pick_vertices(file.read<double>(VtuSection::point_data, name, n_components), n_components,
                               vertices)
               : Points();
  };
  frame.displacement = read("displacement", 3);
  frame.velocity = read("velocity", 3);
  frame.strain_displacement = read("strain_displacement", 2);
  if (frame.strain_displacement.cols() == 0) return;
  const auto mean = file.read<double>(VtuSection::field_data, "mean_stress", 3);
  if (mean.size() != 3 * frame.blocks.size()) file.fail("its mean stresses are not one a block");
  frame.mean_stress = Eigen::Map<const Tensors>(mean.data(), 3, frame.n_blocks());
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
  const std::vector<int> vertices = read_outlines(blocks, frame);
  read_materials(blocks, vertices, frame);
  read_fields(blocks, vertices, frame);
  if (read_one<double>(contacts, "TimeValue") != frame.time) contacts.fail("it is of another moment");
  read_contacts(contacts, frame);
  return frame;
}

}  // namespace ddacontact
