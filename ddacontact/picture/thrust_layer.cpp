#include <ddacontact/picture/thrust_layer.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace ddacontact {

namespace {

constexpr double loaded = 1e-6;  // of the largest resultant
constexpr double end_size = 5;   // px
const Colour thrust_colour{176, 0, 112};
constexpr const char* thrust_width = "2.2";  // px

std::string look_of_thrust() {
  return "stroke=\"" + hex(thrust_colour) + "\" stroke-width=\"" + thrust_width +
         "\" stroke-linecap=\"round\"";
}

}  // namespace

std::vector<JointResultant> joint_resultants(const Frame& frame) {
  struct Sum {
    Vec2 force{0, 0}, moment{0, 0};
    double normal = 0;
  };
  std::map<std::pair<int, int>, Sum> sums;
  for (const FrameContact& contact : frame.contacts) {
    Sum& sum = sums[std::minmax(contact.vertex_block, contact.edge_block)];
    const double normal = std::abs(contact.normal_force);
    sum.force += (contact.vertex_block < contact.edge_block ? 1 : -1) * contact.force();
    sum.moment += normal * contact.position;
    sum.normal += normal;
  }
  std::vector<JointResultant> all;
  for (const auto& [blocks, sum] : sums)
    if (sum.normal > 0) all.push_back({blocks.first, blocks.second, sum.moment / sum.normal, sum.force});
  return all;
}

std::vector<std::pair<Vec2, Vec2>> line_of_thrust(const Frame& frame) {
  const std::vector<JointResultant> joints = joint_resultants(frame);
  double largest = 0;
  for (const JointResultant& joint : joints) largest = std::max(largest, joint.force.norm());
  std::map<int, std::vector<Vec2>> places;  // on each block
  for (const JointResultant& joint : joints)
    if (joint.force.norm() >= loaded * largest)
      for (const int block : {joint.first, joint.second}) places[block].push_back(joint.at);
  std::vector<std::pair<Vec2, Vec2>> line;
  for (const auto& [block, at] : places)
    if (at.size() == 2) line.emplace_back(at[0], at[1]);
  return line;
}

void draw_thrust(SvgPage& page, const View& view, const Frame& frame) {
  for (const auto& [from, to] : line_of_thrust(frame)) {
    page.line(view(from), view(to), look_of_thrust());
    for (const Vec2& end : {from, to})
      page.rectangle(view(end) - Vec2::Constant(end_size / 2), Vec2::Constant(end_size),
                     "fill=\"" + hex(thrust_colour) + "\"");
  }
}

LegendItem thrust_explanation() {
  return line_sample(look_of_thrust(), "line of thrust");
}

}  // namespace ddacontact
