#include <ddacontact/study/scene_picture.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/touching_edges.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/svg.hpp>
#include <ddacontact/picture/view.hpp>
#include <ddacontact/picture/water_layer.hpp>
#include <ddacontact/scene/joint_strengths.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr double margin = 0.08;           // of the larger side of the scene
constexpr double symbol = 9, arrow = 34;  // px
constexpr double caption_height = 34, border = 12;
constexpr double smallest_text = 5, number_size = 8, name_size = 12;

const Colour red{190, 30, 45}, green{0, 110, 80}, grey{110, 110, 110}, purple{120, 30, 140};

double size_of(const Points& polygon) {
  return std::sqrt(std::abs(polyfem::signed_area(polygon)));
}

/// That an edge of one of the blocks names, else that of the materials.
int joint_of_face(const Scene& scene, const JointTable& joints, int a, Index edge_a, int b, Index edge_b) {
  const auto names_one = [&](int block, Index edge) {
    const std::vector<int>& of_edges = scene.blocks[block].edge_joints;
    return !of_edges.empty() && of_edges[edge] >= 0;
  };
  return names_one(b, edge_b) && !names_one(a, edge_a)
             ? joint_of_edge(scene, joints, b, static_cast<int>(edge_b), a)
             : joint_of_edge(scene, joints, a, static_cast<int>(edge_a), b);
}

void add_faces(const Scene& scene, const JointTable& joints, int a, int b, std::vector<SharedFace>& faces) {
  const Points &p = scene.blocks[a].vertices, &q = scene.blocks[b].vertices;
  for (const auto& [edge, other, from, to] :
       touching_edges(p, q, edges_touch * std::min(size_of(p), size_of(q)))) {
    const Vec2 start = p.col(edge), along = p.col((edge + 1) % p.cols()) - start;
    faces.push_back(
        {a, b, joint_of_face(scene, joints, a, edge, b, other), start + from * along, start + to * along});
  }
}

class ScenePicture {
 public:
  ScenePicture(const Scene& scene, const ScenePictureOptions& options) : scene_(scene), options_(options) {
    const double infinity = std::numeric_limits<double>::infinity();
    Window box{Vec2::Constant(infinity), Vec2::Constant(-infinity)};
    for (const BlockDescription& block : scene.blocks) {
      box.low = box.low.cwiseMin(block.vertices.rowwise().minCoeff());
      box.high = box.high.cwiseMax(block.vertices.rowwise().maxCoeff());
    }
    view_.box = padded(with_water(box, scene.water), margin);
    view_.corner = Vec2(border, scene.title.empty() ? border : caption_height);
    view_.scale = (options.width - 2 * border) / view_.box.width();
  }

  std::string draw() {
    if (!scene_.title.empty()) page_.text({border, 22}, scene_.title, {.size = 14, .bold = true});
    draw_blocks();
    draw_joints();
    for (const Support& support : scene_.supports) draw_support(support);
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) draw_fixed(static_cast<int>(b));
    for (const RockBolt& bolt : scene_.bolts) draw_bolt(bolt);
    for (const Load& load : scene_.loads) draw_load(load);
    draw_water(page_, view_, scene_.water);
    if (options_.numbers)
      for (const BlockDescription& block : scene_.blocks) draw_numbers(block);
    if (options_.names)
      for (std::size_t b = 0; b < scene_.blocks.size(); ++b) draw_name(static_cast<int>(b));
    for (const Monitor& monitor : scene_.monitors) draw_monitor(monitor);
    const double bottom = view_.corner.y() + view_.size().y(), width = options_.width - 2 * border;
    const std::vector<LegendItem> items = legend();
    draw_legend(page_, {border, bottom}, items, width);
    return page_.finish(options_.width, bottom + legend_line_height * legend_lines(items, width) + border);
  }

 private:
  Vec2 centroid(int b) const { return polyfem::area_moments(scene_.blocks[b].vertices).centroid; }

  PathData outline(const Points& polygon) const {
    std::vector<Vec2> corners;
    for (Index k = 0; k < polygon.cols(); ++k) corners.push_back(view_(polygon.col(k)));
    PathData path;
    path.polygon(corners);
    return path;
  }

  void draw_blocks() {
    std::vector<Colour> colours;
    for (const BlockDescription& block : scene_.blocks) colours.push_back(kind_colour(block.material));
    for (const MarkedBlocks& mark : options_.marks)
      for (const int b : mark.blocks) colours[b] = mark.colour;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b)
      page_.path(outline(scene_.blocks[b].vertices),
                 "fill=\"" + hex(colours[b]) + "\" stroke=\"#444\" stroke-width=\".7\"");
  }

  void draw_joints() {
    for (const SharedFace& face : shared_faces(scene_)) {
      page_.line(view_(face.from), view_(face.to),
                 "stroke=\"" + hex(line_colour(face.joint)) + "\" stroke-width=\"2\"");
      if (std::ranges::count(joints_shown_, face.joint) == 0) joints_shown_.push_back(face.joint);
    }
    std::ranges::sort(joints_shown_);
  }

  void shape(const std::vector<Vec2>& corners, const Colour& colour) {
    PathData path;
    path.polygon(corners);
    page_.path(path, "fill=\"" + hex(colour) + "\"");
  }

  /// With its tip at the vertex: below it where y is held, beside it where x alone is.
  void held(const Vec2& vertex, bool y, bool moves) {
    const Vec2 at = view_(vertex), away = y ? Vec2(0, symbol) : Vec2(-symbol, 0);
    const Vec2 across = Vec2(away.y(), away.x()) / 2;
    shape({at, at + away + across, at + away - across}, moves ? red : green);
  }

  void draw_support(const Support& support) {
    const TimeFunction& motion = support.displacement;
    const bool moves = !motion.value.isZero(0) || motion.is_history();
    for (const int k : support.vertices)
      held(scene_.blocks[support.block].vertices.col(k), support.fix_y, moves);
    (moves ? any_moving_ : any_prescribed_) |= !support.vertices.empty();
  }

  void draw_fixed(int b) {
    const BlockDescription& block = scene_.blocks[b];
    for (Index k = 0; k < block.vertices.cols(); ++k)
      if (block.fixed || std::ranges::count(block.fixed_vertices, k) > 0) {
        held(block.vertices.col(k), true, false);
        any_prescribed_ = true;
      }
  }

  /// Ends at the point.
  void arrow_to(const Vec2& point, const Vec2& direction) {
    const Vec2 tip = view_(point), t = Vec2(direction.x(), -direction.y()).normalized(), n(-t.y(), t.x());
    page_.line(tip - arrow * t, tip - symbol * t, "stroke=\"" + hex(red) + "\" stroke-width=\"2\"");
    shape({tip, tip - symbol * t + symbol / 2.5 * n, tip - symbol * t - symbol / 2.5 * n}, red);
    any_load_ = true;
  }

  /// The largest of its directions in time.
  static Vec2 direction_of(const TimeFunction& force) {
    Vec2 largest = force.value;
    for (const Vec3& entry : force.history)
      if (entry.tail<2>().norm() > largest.norm()) largest = entry.tail<2>();
    return largest;
  }

  void draw_load(const Load& load) {
    const Points& polygon = scene_.blocks[load.block].vertices;
    if (load.kind == Load::Kind::pressure) {
      const Vec2 start = polygon.col(load.edge), end = polygon.col((load.edge + 1) % polygon.cols());
      const double side = polyfem::signed_area(polygon) > 0 ? 1 : -1;
      const Vec2 inwards = side * Vec2(start.y() - end.y(), end.x() - start.x());
      for (const double part : {1.0 / 6, 0.5, 5.0 / 6})
        arrow_to((1 - part) * start + part * end,
                 direction_of(load.force).x() < 0 ? Vec2(-inwards) : inwards);
      return;
    }
    const Vec2 direction = direction_of(load.force);
    if (!direction.isZero(0))
      arrow_to(load.kind == Load::Kind::point ? load.at : centroid(load.block), direction);
  }

  /// A plate at each end of an anchored one.
  void draw_bolt(const RockBolt& bolt) {
    const Vec2 from = view_(bolt.from), to = view_(bolt.to), along = (to - from).normalized();
    const std::string look = "stroke=\"" + hex(purple) + "\" stroke-width=\"2.5\"";
    page_.line(from, to, look);
    const Vec2 plate = symbol / 2 * Vec2(-along.y(), along.x());
    for (const Vec2& end : {from, to})
      if (bolt.kind == RockBolt::Kind::anchored) page_.line(end - plate, end + plate, look);
    if (options_.names) page_.text(to + Vec2(symbol / 2, 0), bolt.name, {.size = 10, .halo = true});
  }

  /// Beside the vertices and the middles of edges, inwards.
  void draw_numbers(const BlockDescription& block) {
    const Points& polygon = block.vertices;
    const Vec2 middle = view_(polyfem::area_moments(polygon).centroid);
    const auto number = [&](const Vec2& at, const std::string& text, const Colour& colour) {
      const Vec2 towards = middle - at;
      const Vec2 shift = std::min(0.35, number_size / std::max(towards.norm(), 1e-9)) * towards;
      page_.text(at + shift + Vec2(0, 0.35 * number_size), text,
                 {.size = number_size, .anchor = Anchor::middle, .colour = colour, .halo = true});
    };
    for (Index k = 0; k < polygon.cols(); ++k) {
      const Vec2 start = polygon.col(k), end = polygon.col((k + 1) % polygon.cols());
      number(view_(start), std::to_string(k), {34, 34, 34});
      number(view_((start + end) / 2), "e" + std::to_string(k), grey);
    }
  }

  void draw_name(int b) {
    const std::string name = scene_.block_name(b);
    const Points& polygon = scene_.blocks[b].vertices;
    const Vec2 extent = view_.scale * (polygon.rowwise().maxCoeff() - polygon.rowwise().minCoeff());
    const double size = std::min({name_size, 0.8 * extent.x() / text_width(name, 1), 0.6 * extent.y()});
    if (size < smallest_text) return;
    page_.text(view_(centroid(b)) + Vec2(0, 0.35 * size), name,
               {.size = size, .anchor = Anchor::middle, .halo = true});
  }

  void draw_monitor(const Monitor& monitor) {
    const Vec2 at = view_(monitor.kind == Monitor::Kind::point ? monitor.at
                          : monitor.kind == Monitor::Kind::vertex
                              ? Vec2(scene_.blocks[monitor.block].vertices.col(monitor.vertex))
                              : centroid(monitor.block));
    const double r = symbol / 2;
    shape({at + Vec2(r, 0), at + Vec2(0, r), at - Vec2(r, 0), at - Vec2(0, r)}, {34, 34, 34});
    if (options_.names) page_.text(at + Vec2(symbol, -r), monitor.name, {.size = 10, .halo = true});
  }

  std::vector<LegendItem> legend() const {
    std::vector<LegendItem> items{scale_bar(view_.scale, 120)};
    for (std::size_t m = 0; m < scene_.materials.size(); ++m)
      items.push_back(swatch(kind_colour(static_cast<int>(m)), scene_.materials[m].name));
    for (const MarkedBlocks& mark : options_.marks) items.push_back(swatch(mark.colour, mark.name));
    for (const int j : joints_shown_) {
      const std::string& name = scene_.joints[j].name;
      items.push_back(swatch(line_colour(j), "joint " + (name.empty() ? std::to_string(j) : name)));
    }
    if (any_prescribed_) items.push_back(swatch(green, "held"));
    if (any_moving_) items.push_back(swatch(red, "moved"));
    if (any_load_) items.push_back(swatch(red, "load"));
    for (LegendItem& item : water_explanations({scene_.water}, {view_.box})) items.push_back(std::move(item));
    if (!scene_.bolts.empty()) items.push_back(swatch(purple, "bolt"));
    if (!scene_.monitors.empty()) items.push_back(swatch({34, 34, 34}, "monitor"));
    return items;
  }

  const Scene& scene_;
  const ScenePictureOptions& options_;
  View view_;
  SvgPage page_;
  std::vector<int> joints_shown_;
  bool any_prescribed_ = false, any_moving_ = false, any_load_ = false;
};

}  // namespace

std::vector<SharedFace> shared_faces(const Scene& scene) {
  std::vector<Box> boxes;
  for (const BlockDescription& block : scene.blocks)
    boxes.push_back(bounding_box(PointsRef(block.vertices), edges_touch * size_of(block.vertices)));
  std::vector<SharedFace> faces;
  if (scene.joints.empty()) return faces;
  const JointTable joints = joint_table(scene.joints);
  for (const auto& [a, b] : overlapping_pairs(boxes)) add_faces(scene, joints, a, b, faces);
  return faces;
}

std::string draw(const Scene& scene, const ScenePictureOptions& options) {
  if (scene.blocks.empty()) throw Error("the scene has no block to be drawn");
  return ScenePicture(scene, options).draw();
}

}  // namespace ddacontact
