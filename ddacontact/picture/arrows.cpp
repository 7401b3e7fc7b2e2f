#include <ddacontact/picture/arrows.hpp>

#include <ddacontact/picture/block_layer.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ddacontact {

namespace {

constexpr double shaft = 0.75, head_half_width = 2.9, longest_head = 7.5, line_width = 1.5;

/// Joints are vertical when their normals rise by less than this, and blocks as large as each other when
/// their areas differ by less than this part.
constexpr double vertical = 0.02, as_large = 0.01;

/// On which block of a pair forces are drawn.
class DrawnOn {
 public:
  explicit DrawnOn(const Frame& frame) : frame_(frame) {
    for (const FrameContact& contact : frame.contacts)
      normals_.try_emplace(pair_of(contact), Vec2(0, 0)).first->second += sense(contact) * contact.normal;
  }

  bool the_vertex_block(const FrameContact& contact) const {
    return is_first(pair_of(contact)) == (sense(contact) > 0);
  }

 private:
  using Pair = std::pair<int, int>;
  static Pair pair_of(const FrameContact& contact) {
    return std::minmax(contact.vertex_block, contact.edge_block);
  }
  /// Of the normal, for it to point into the first block of the pair.
  static double sense(const FrameContact& contact) {
    return contact.vertex_block < contact.edge_block ? 1 : -1;
  }
  double area(int block) const { return std::abs(polyfem::signed_area(frame_.outline(block))); }

  bool is_held(int block) const {
    const Range& range = frame_.blocks[static_cast<std::size_t>(block)];
    return holds(frame_, Field::displacement) &&
           frame_.displacement.middleCols(range.first, range.count).isZero(0);
  }

  bool is_first(const Pair& pair) const {
    const auto [first, second] = pair;
    if (is_held(first) != is_held(second)) return is_held(second);
    const Vec2 into_first = normals_.at(pair);
    if (std::abs(into_first.y()) > vertical * into_first.norm()) return into_first.y() > 0;
    const double a = area(first), b = area(second);
    if (std::abs(a - b) > as_large * std::max(a, b)) return a < b;
    return middle(frame_, first).x() > middle(frame_, second).x();
  }

  const Frame& frame_;
  std::map<Pair, Vec2> normals_;  ///< sums of those of all contacts, into the first block
};

std::vector<Arrow> contact_forces(const Frame& frame) {
  const DrawnOn drawn_on(frame);
  std::vector<Arrow> arrows;
  for (const FrameContact& contact : frame.contacts) {
    const bool slips =
        contact.state == ContactState::slip_forward || contact.state == ContactState::slip_backward;
    const double sense = drawn_on.the_vertex_block(contact) ? 1 : -1;
    arrows.push_back(
        {contact.position, sense * contact.force(), slips ? Arrow::Look::slipping : Arrow::Look::plain});
  }
  return arrows;
}

std::vector<Arrow> vertex_means(const Frame& frame, const Points& vectors) {
  std::vector<Arrow> arrows;
  for (int b : frame.present_blocks()) {
    const Range& range = frame.blocks[static_cast<std::size_t>(b)];
    arrows.push_back({middle(frame, b), vectors.middleCols(range.first, range.count).rowwise().mean()});
  }
  return arrows;
}

std::vector<Arrow> principal_lines(const Frame& frame) {
  std::vector<Arrow> arrows;
  for (int b : frame.present_blocks()) {
    const auto principal = polyfem::principal_stresses(frame.mean_stress.col(b));
    const Vec2 first(std::cos(principal.angle), std::sin(principal.angle)), second(-first.y(), first.x());
    const auto look = [](double s) { return s > 0 ? Arrow::Look::tension : Arrow::Look::compression; };
    arrows.push_back({middle(frame, b), std::abs(principal.s1) * first, look(principal.s1)});
    arrows.push_back({middle(frame, b), std::abs(principal.s2) * second, look(principal.s2)});
  }
  return arrows;
}

void add_arrow(PathData& data, const Vec2& from, const Vec2& vector) {
  const double length = vector.norm();
  const Vec2 along = vector / length, across(-along.y(), along.x());
  const double head = std::min(longest_head, 0.6 * length), half = head_half_width * head / longest_head;
  const Vec2 neck = from + (length - head) * along;
  data.polygon({from + shaft * across, neck + shaft * across, neck + half * across, from + vector,
                neck - half * across, neck - shaft * across, from - shaft * across});
}

void add_line(PathData& data, const Vec2& middle, const Vec2& vector) {
  data.move_to(middle - vector / 2);
  data.line_to(middle + vector / 2);
}

Colour colour_of(VectorKind kind, Arrow::Look look) {
  switch (look) {
    case Arrow::Look::slipping:
      return perceptual_colour(0.62, 0.19, 40);
    case Arrow::Look::tension:
      return perceptual_colour(0.55, 0.2, 28);
    case Arrow::Look::compression:
      return perceptual_colour(0.42, 0.15, 258);
    case Arrow::Look::plain:
      break;
  }
  if (kind == VectorKind::displacement) return perceptual_colour(0.45, 0.11, 155);
  if (kind == VectorKind::velocity) return perceptual_colour(0.42, 0.17, 310);
  return {20, 20, 20};
}

void draw(SvgPage& page, const PathData& data, VectorKind kind, Arrow::Look look) {
  const std::string colour = hex(colour_of(kind, look));
  if (kind == VectorKind::principal_stresses) {
    page.path(data, "fill=\"none\" stroke=\"#fff\" stroke-width=\"" + pixel_text(line_width + 1.4) + "\"");
    page.path(data,
              "fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + pixel_text(line_width) + "\"");
  } else {
    page.path(data, "fill=\"" + colour + "\" stroke=\"#fff\" stroke-width=\"0.8\" paint-order=\"stroke\"");
  }
}

}  // namespace

const char* unit_of(VectorKind kind) {
  switch (kind) {
    case VectorKind::contact_forces:
      return "N/m";
    case VectorKind::displacement:
      return "m";
    case VectorKind::velocity:
      return "m/s";
    default:
      return "Pa";
  }
}

bool holds(const Frame& frame, VectorKind kind) {
  if (kind == VectorKind::displacement) return holds(frame, Field::displacement);
  if (kind == VectorKind::velocity) return holds(frame, Field::velocity);
  return kind == VectorKind::contact_forces || frame.mean_stress.cols() == frame.n_blocks();
}

std::vector<Arrow> arrows_of(const Frame& frame, VectorKind kind) {
  switch (kind) {
    case VectorKind::contact_forces:
      return contact_forces(frame);
    case VectorKind::displacement:
      return vertex_means(frame, frame.displacement);
    case VectorKind::velocity:
      return vertex_means(frame, frame.velocity);
    default:
      return principal_lines(frame);
  }
}

double largest(const std::vector<Arrow>& arrows) {
  double largest = 0;
  for (const Arrow& arrow : arrows)
    if (arrow.vector.allFinite()) largest = std::max(largest, arrow.vector.norm());
  return largest;
}

void draw_arrows(SvgPage& page, const View& view, const std::vector<Arrow>& arrows, VectorKind kind,
                 double pixels_per_unit) {
  std::array<PathData, 4> looks;
  for (const Arrow& arrow : arrows) {
    const Vec2 vector = pixels_per_unit * Vec2(arrow.vector.x(), -arrow.vector.y());
    if (!(vector.norm() >= 1)) continue;
    PathData& data = looks[static_cast<std::size_t>(arrow.look)];
    if (kind == VectorKind::principal_stresses)
      add_line(data, view(arrow.from), vector);
    else
      add_arrow(data, view(arrow.from), vector);
  }
  for (std::size_t look = 0; look < looks.size(); ++look)
    draw(page, looks[look], kind, static_cast<Arrow::Look>(look));
}

void draw_sample(SvgPage& page, const Vec2& from, double pixels, VectorKind kind, Arrow::Look look) {
  PathData data;
  if (kind == VectorKind::principal_stresses)
    add_line(data, from + Vec2(pixels / 2, 0), Vec2(pixels, 0));
  else
    add_arrow(data, from, Vec2(pixels, 0));
  draw(page, data, kind, look);
}

}  // namespace ddacontact
