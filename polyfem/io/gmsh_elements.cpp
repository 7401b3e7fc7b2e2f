#include <polyfem/io/gmsh_elements.hpp>

#include <cmath>
#include <optional>

namespace polyfem {
namespace {

/// How many nodes an element type has that becomes an edge or a cell; 0 for a point.
int n_nodes_of(int type, const LineReader& in) {
  switch (type) {
    case 1:
      return 2;
    case 2:
      return 3;
    case 3:
      return 4;
    case 15:
      return 0;
    case 8:
    case 9:
    case 10:
    case 16:
      in.fail("elements of type " + std::to_string(type) +
              " are of second order: set Mesh.ElementOrder = 1 and use with_edge_midpoints");
    default:
      in.fail("elements of type " + std::to_string(type) +
              " are neither lines, triangles nor quadrilaterals: mesh in two dimensions (gmsh -2)");
  }
}

/// Reads the sections one after another.
class Sections {
 public:
  explicit Sections(LineReader& in) : in_(in) {}

  GmshFile read() {
    read_format();
    bool has_nodes = false, has_elements = false;
    while (in_.next_line()) {
      const std::string section(in_.rest());
      if (section == "$PhysicalNames")
        read_names();
      else if (section == "$Entities")
        read_entities();
      else if (section == "$Nodes") {
        is_old_ ? read_nodes() : read_node_blocks();
        has_nodes = true;
      } else if (section == "$Elements") {
        is_old_ ? read_elements() : read_element_blocks();
        has_elements = true;
      } else {
        pass_over(section);
        continue;
      }
      in_.require_line("$End" + section.substr(1));
      if (in_.rest() != "$End" + section.substr(1))
        in_.fail("\"" + std::string(in_.rest()) + "\" stands where $End" + section.substr(1) +
                 " should: see that the numbers of the section fit what it holds");
    }
    if (!has_nodes || !has_elements)
      in_.fail("the file has no " + std::string(has_nodes ? "$Elements" : "$Nodes") +
               ": mesh the model before it is saved (gmsh -2)");
    return file_;
  }

 private:
  void read_format() {
    in_.require_line("$MeshFormat");
    if (in_.rest() != "$MeshFormat") in_.fail("a .msh file starts with $MeshFormat: save the mesh as .msh");
    in_.require_line("the version");
    const std::string version(in_.word());
    if (version != "2.2" && version != "4.1")
      in_.fail("version " + version + " of the format is not read: save as 2.2 or 4.1 (gmsh -format msh41)");
    is_old_ = version == "2.2";
    if (in_.whole_number("0 for ASCII") != 0)
      in_.fail("the file is binary: save it as ASCII (Mesh.Binary = 0)");
    in_.require_line("$EndMeshFormat");
  }

  void pass_over(const std::string& section) {
    if (section[0] != '$') in_.fail("\"" + section + "\" belongs to no section: it should start with $");
    const int start = in_.line_number();
    while (in_.next_line())
      if (in_.rest() == "$End" + section.substr(1)) return;
    in_.fail("section " + section + " has no end: the file is cut short; write it again", start);
  }

  void read_names() {
    in_.require_line("the number of names");
    const int n = in_.whole_number("the number of names");
    for (int k = 0; k < n; ++k) {
      in_.require_line("a name");
      const int dimension = in_.whole_number("the dimension of a group");
      const int tag = in_.whole_number("the number of a group", 1);
      const std::string_view name = in_.rest();
      if (name.size() < 3 || name.front() != '"' || name.back() != '"')
        in_.fail("the group's name is not quoted or empty: write dimension, number and \"name\"");
      GmshGroup group{std::string(name.substr(1, name.size() - 2)), in_.line_number()};
      if (dimension == 1) file_.line_groups[tag] = group;
      if (dimension == 2) file_.cell_groups[tag] = group;
    }
  }

  /// Version 4.1 gives groups to the curves and surfaces of the model.
  void read_entities() {
    in_.require_line("the numbers of points, curves, surfaces and volumes");
    int counts[4];
    for (int& count : counts) count = in_.whole_number("the number of points, curves, surfaces and volumes");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (int k = 0; k < counts[dimension]; ++k) {
        in_.require_line("an entity");
        const int tag = in_.whole_number("the number of an entity", -1);
        for (int box = 0; box < (dimension == 0 ? 3 : 6); ++box) in_.number("a coordinate");
        std::vector<int>& groups = groups_of_entity_[{dimension, tag}];
        groups.resize(static_cast<std::size_t>(in_.whole_number("how many groups an entity has")));
        for (int& group : groups) group = std::abs(in_.whole_number("the number of a group", -(1 << 30)));
      }
  }

  void add_node(int tag) {
    Vec2 x;
    for (double& coordinate : x) coordinate = in_.number("x, y and z of a node");
    const double z = in_.number("x, y and z of a node");
    if (!z_) z_ = z;
    if (std::abs(z - *z_) > 1e-9 * (x.norm() + std::abs(z)))
      in_.fail("node " + std::to_string(tag) + " is not in the plane of the first one: give all the same z");
    if (!file_.nodes.emplace(tag, x).second)
      in_.fail("node " + std::to_string(tag) + " is there twice: number nodes anew (gmsh -save_all)");
    file_.node_tags.push_back(tag);
  }

  void read_nodes() {
    in_.require_line("the number of nodes");
    const int n = in_.whole_number("the number of nodes");
    for (int k = 0; k < n; ++k) {
      in_.require_line("a node");
      add_node(in_.whole_number("the number of a node", 1));
    }
  }

  void read_node_blocks() {
    in_.require_line("the numbers of blocks and nodes");
    const int n_blocks = in_.whole_number("the number of blocks");
    for (int block = 0; block < n_blocks; ++block) {
      in_.require_line("a block of nodes");
      in_.whole_number("the dimension of a block");
      in_.whole_number("the entity of a block");
      in_.whole_number("0 or 1 for parametric coordinates");
      std::vector<int> tags(static_cast<std::size_t>(in_.whole_number("the number of nodes of a block")));
      for (int& tag : tags) {
        in_.require_line("the number of a node");
        tag = in_.whole_number("the number of a node", 1);
      }
      for (const int tag : tags) {
        in_.require_line("a node");
        add_node(tag);
      }
    }
  }

  void add_element(int type, int n_nodes, std::vector<int> groups) {
    GmshElement element{std::vector<int>(static_cast<std::size_t>(n_nodes)), std::move(groups),
                        in_.line_number()};
    for (int& node : element.nodes) {
      node = in_.whole_number("the number of a node", 1);
      if (!file_.nodes.contains(node))
        in_.fail("there is no node " + std::to_string(node) + ": add it to $Nodes, or correct the number");
    }
    (type == 1 ? file_.lines : file_.cells).push_back(std::move(element));
  }

  void read_elements() {
    in_.require_line("the number of elements");
    const int n = in_.whole_number("the number of elements");
    for (int k = 0; k < n; ++k) {
      in_.require_line("an element");
      in_.whole_number("the number of an element", 1);
      const int type = in_.whole_number("the type of an element", 1), n_nodes = n_nodes_of(type, in_);
      const int n_tags = in_.whole_number("the number of tags");
      int group = 0;
      for (int tag = 0; tag < n_tags; ++tag) {
        const int value = in_.whole_number("a tag", -(1 << 30));
        if (tag == 0) group = std::abs(value);  // negative where the group turns the element round
      }
      if (n_nodes > 0) add_element(type, n_nodes, group == 0 ? std::vector<int>{} : std::vector{group});
    }
  }

  void read_element_blocks() {
    in_.require_line("the numbers of blocks and elements");
    const int n_blocks = in_.whole_number("the number of blocks");
    for (int block = 0; block < n_blocks; ++block) {
      in_.require_line("a block of elements");
      const int dimension = in_.whole_number("the dimension of a block");
      const int entity = in_.whole_number("the entity of a block");
      const int type = in_.whole_number("the type of a block's elements", 1), n_nodes = n_nodes_of(type, in_);
      const int n = in_.whole_number("the number of elements of a block");
      const auto groups = groups_of_entity_.find({dimension, entity});
      for (int k = 0; k < n; ++k) {
        in_.require_line("an element");
        in_.whole_number("the number of an element", 1);
        if (n_nodes > 0)
          add_element(type, n_nodes, groups == groups_of_entity_.end() ? std::vector<int>{} : groups->second);
      }
    }
  }

  LineReader& in_;
  GmshFile file_;
  bool is_old_ = false;  ///< version 2.2
  std::optional<double> z_;
  std::map<std::pair<int, int>, std::vector<int>> groups_of_entity_;  ///< by dimension and tag
};

}  // namespace

GmshFile read_gmsh_file(LineReader& in) {
  return Sections(in).read();
}

}  // namespace polyfem
