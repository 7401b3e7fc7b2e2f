#include <ddacontact/picture/field_layer.hpp>

#include <ddacontact/picture/contour.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace ddacontact {

namespace {

constexpr double triangle_pixels = 7;
constexpr int fewest_rings = 4, most_rings = 120;
/// Of the largest mean stress of a block: what iterations leave of stresses that are none.
constexpr double negligible = 1e-6;
constexpr double tail = 0.01;          // of the area, that colours need not tell apart at either end
constexpr double worth_cutting = 1.5;  // how much longer the range of all values is then

/// How finely each triangle of the centroid fan is divided; blocks of a few pixels need less.
int rings_for(const Points& outline, double pixels_per_metre) {
  const Index n = outline.cols();
  double longest = 0;
  for (Index i = 0; i < n; ++i)
    longest = std::max(longest, (outline.col((i + 1) % n) - outline.col(i)).norm());
  const double pixels = pixels_per_metre * longest;
  const double least = std::clamp<double>(std::ceil(pixels / 2), 1, fewest_rings);
  return static_cast<int>(std::clamp<double>(std::ceil(pixels / triangle_pixels), least, most_rings));
}

/// The bands to draw on a block's lowest one, ascending, the highest among them; those whose regions would be
/// told apart by less than a pixel are left out.
std::vector<int> bands_above(int lowest, int highest, double pixels) {
  const int n = highest - lowest;
  const int stride = std::max(1, static_cast<int>(std::ceil(n / std::max(pixels, 1.))));
  std::vector<int> bands;
  for (int band = highest; band > lowest; band -= stride) bands.push_back(band);
  std::reverse(bands.begin(), bands.end());
  return bands;
}

void widen(ValueRange& range, const Eigen::Ref<const VectorXd>& values, bool first) {
  range.low = first ? values.minCoeff() : std::min(range.low, values.minCoeff());
  range.high = first ? values.maxCoeff() : std::max(range.high, values.maxCoeff());
}

std::vector<bool> cells_of_divided_blocks(const Frame& frame) {
  std::vector<int> n_cells(static_cast<std::size_t>(frame.n_blocks()), 0);
  for (const FrameCell& cell : frame.cells) ++n_cells[static_cast<std::size_t>(cell.block)];
  std::vector<bool> divided;
  for (const FrameCell& cell : frame.cells)
    divided.push_back(n_cells[static_cast<std::size_t>(cell.block)] > 1);
  return divided;
}

struct WeighedValue {
  double value, area;
};

ValueRange percentiles_of(std::vector<WeighedValue> values) {
  std::ranges::sort(values, {}, &WeighedValue::value);
  double total = 0;
  for (const WeighedValue& of : values) total += of.area;
  const auto value_at = [&](double area) {
    for (const auto& [value, weight] : values)
      if ((area -= weight) <= 0) return value;
    return values.empty() ? 0 : values.back().value;
  };
  return {value_at(tail * total), value_at((1 - tail) * total)};
}

/// Of a cell, from the first.
Points corners_of(const Frame& frame, int cell) {
  const std::span<const int> points = frame.corners(cell);
  Points corners(2, static_cast<Index>(points.size()));
  for (Index k = 0; k < corners.cols(); ++k)
    corners.col(k) = frame.position.col(points[static_cast<std::size_t>(k)]) - frame.position.col(points[0]);
  return corners;
}

}  // namespace

FieldSamples::FieldSamples(const Frame& frame, Field field, double pixels_per_metre, const Frame& drawn)
    : frame_(drawn) {
  const bool of_stress = is_stress(field);
  const double least =
      of_stress && frame.mean_stress.size() > 0 ? negligible * frame.mean_stress.cwiseAbs().maxCoeff() : 0;
  const std::vector<bool> is_divided = cells_of_divided_blocks(frame);
  for (int c = 0; c < frame.n_cells(); ++c) {
    CellField value(frame, c, field, least);
    const Points drawn_corners = corners_of(drawn, c);
    for (const CellPiece& corners : pieces_of(value.corners())) {
      const Points outline = value.corners()(Eigen::all, corners), seen = drawn_corners(Eigen::all, corners);
      const FanMesh mesh(static_cast<int>(corners.size()), rings_for(seen, pixels_per_metre));
      const Points nodes = mesh.nodes(outline, centre_of(outline));
      Piece& piece = pieces_.emplace_back(Piece{c, corners, mesh, mesh.nodes(seen, centre_of(seen)), {}});
      piece.values.resize(nodes.cols());
      const Vec2 centre = nodes.col(0);
      for (Index i = 0; i < nodes.cols(); ++i)
        piece.values[i] = value(of_stress ? stress_place(centre, nodes.col(i)) : Vec2(nodes.col(i)));
      const bool first = pieces_.size() == 1;
      widen(range_, piece.values, first);
      const int rings = is_divided[static_cast<std::size_t>(c)] ? (mesh.rings() + 1) / 2 : mesh.rings();
      widen(telling_range_, piece.values.head(FanMesh(mesh.n_corners(), rings).n_nodes()), first);
    }
  }
  if (!of_stress) return;
  const ValueRange most = percentiles(field, is_divided);
  has_peaks_ = telling_range_.high - telling_range_.low > worth_cutting * (most.high - most.low);
  if (has_peaks_) telling_range_ = most;
}

/// Nodes stand for equal parts of their piece's area. Where nearly all of the area has one value, as that of
/// a slope that stones fall down, the percentiles are those of each block.
ValueRange FieldSamples::percentiles(Field field, const std::vector<bool>& is_divided) const {
  std::vector<WeighedValue> all;
  std::map<int, std::vector<WeighedValue>> of_blocks;
  for (const Piece& piece : pieces_) {
    const bool inner = is_divided[static_cast<std::size_t>(piece.cell)];
    const int rings = inner ? (piece.mesh.rings() + 1) / 2 : piece.mesh.rings();
    const Index n = FanMesh(piece.mesh.n_corners(), rings).n_nodes();
    const Points outline = piece.nodes.rightCols(piece.mesh.n_outline_nodes());
    const double area = std::abs(polyfem::signed_area(outline)) / static_cast<double>(n);
    std::vector<WeighedValue>& of_block = of_blocks[frame_.cells[static_cast<std::size_t>(piece.cell)].block];
    for (Index i = 0; i < n; ++i) of_block.push_back({piece.values[i], area});
  }
  for (const auto& [block, values] : of_blocks) all.insert(all.end(), values.begin(), values.end());
  ValueRange range = percentiles_of(std::move(all));
  if (!is_one_value(range, field)) return range;
  for (auto& [block, values] : of_blocks) {
    const ValueRange of_block = percentiles_of(std::move(values));
    range = {std::min(range.low, of_block.low), std::max(range.high, of_block.high)};
  }
  return range;
}

/// The lowest band of each piece and its neighbours: painted under all of them, it closes the seams between
/// them.
std::vector<int> FieldSamples::grounds(const ColourScale& scale) const {
  std::vector<int> at_place(static_cast<std::size_t>(frame_.position.cols()), scale.n_bands());
  const auto for_each_corner = [&](auto&& visit) {
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int corner : pieces_[p].corners)
        visit(p, static_cast<std::size_t>(frame_.corners(pieces_[p].cell)[static_cast<std::size_t>(corner)]));
  };
  std::vector<int> lowest;
  for (const Piece& piece : pieces_) lowest.push_back(scale.band(piece.values.minCoeff()));
  for_each_corner(
      [&](std::size_t p, std::size_t point) { at_place[point] = std::min(at_place[point], lowest[p]); });
  for_each_corner(
      [&](std::size_t p, std::size_t point) { lowest[p] = std::min(lowest[p], at_place[point]); });
  return lowest;
}

void FieldSamples::draw(SvgPage& page, const View& view, const ColourScale& scale) const {
  std::vector<PathData> bands(static_cast<std::size_t>(scale.n_bands()));
  const std::vector<int> ground = grounds(scale);
  for (std::size_t p = 0; p < pieces_.size(); ++p) add_piece(pieces_[p], ground[p], view, scale, bands);
  for (int k = 0; k < scale.n_bands(); ++k)
    page.path(bands[static_cast<std::size_t>(k)], "fill=\"" + hex(scale.colour(k)) + "\"");
}

void FieldSamples::add_piece(const Piece& piece, int ground, const View& view, const ColourScale& scale,
                             std::vector<PathData>& paths) const {
  const std::span<const int> points = frame_.corners(piece.cell);
  const Vec2 start_on_page = view(frame_.position.col(points[0]));
  const int lowest = scale.band(piece.values.minCoeff()), highest = scale.band(piece.values.maxCoeff());
  std::vector<Vec2> corners;
  const Window box{piece.nodes.rowwise().minCoeff(), piece.nodes.rowwise().maxCoeff()};
  for (const int corner : piece.corners)
    corners.push_back(view(frame_.position.col(points[static_cast<std::size_t>(corner)])));
  paths[static_cast<std::size_t>(ground)].polygon(corners);
  if (lowest > ground) paths[static_cast<std::size_t>(lowest)].polygon(corners);

  const double pixels = (box.high - box.low).norm() * view.scale;
  const std::vector<int> bands = bands_above(lowest, highest, pixels);
  std::vector<double> levels;
  for (const int band : bands) levels.push_back(scale.bounds()[static_cast<std::size_t>(band)]);
  const std::vector<Region> regions = superlevel_regions(piece.mesh, piece.nodes, piece.values, levels);
  for (std::size_t k = 0; k < regions.size(); ++k)
    for (const std::vector<Vec2>& polygon : regions[k]) {
      corners.clear();
      for (const Vec2& x : polygon) corners.push_back(start_on_page + view.direction(x));
      paths[static_cast<std::size_t>(bands[k])].polygon(corners);
    }
}

}  // namespace ddacontact
