#include <ddacontact/picture/field_layer.hpp>

#include <ddacontact/picture/contour.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double triangle_pixels = 7;
constexpr int fewest_rings = 4, most_rings = 120;

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

}  // namespace

FieldSamples::FieldSamples(const Frame& frame, Field field, double pixels_per_metre) : frame_(frame) {
  bool first = true;
  for (int b = 0; b < frame.n_blocks(); ++b) {
    BlockField value(frame, b, field);
    const int n_corners = static_cast<int>(value.outline().cols());
    const FanMesh& mesh = meshes_.emplace_back(n_corners, rings_for(value.outline(), pixels_per_metre));
    const Points nodes = mesh.nodes(value.outline(), value.centroid());
    centroids_.push_back(value.centroid());
    VectorXd& values = values_.emplace_back(nodes.cols());
    for (Index i = 0; i < nodes.cols(); ++i) values[i] = value(nodes.col(i));
    range_.low = first ? values.minCoeff() : std::min(range_.low, values.minCoeff());
    range_.high = first ? values.maxCoeff() : std::max(range_.high, values.maxCoeff());
    first = false;
  }
}

void FieldSamples::draw(SvgPage& page, const View& view, const ColourScale& scale) const {
  std::vector<PathData> bands(static_cast<std::size_t>(scale.n_bands()));
  for (int b = 0; b < frame_.n_blocks(); ++b) add_block(b, view, scale, bands);
  for (int k = 0; k < scale.n_bands(); ++k)
    page.path(bands[static_cast<std::size_t>(k)], "fill=\"" + hex(scale.colour(k)) + "\"");
}

void FieldSamples::add_block(int b, const View& view, const ColourScale& scale,
                             std::vector<PathData>& paths) const {
  const auto block = static_cast<std::size_t>(b);
  const auto outline = frame_.outline(b);
  const Vec2 start = outline.col(0), start_on_page = view(start);
  const int lowest = scale.band(values_[block].minCoeff()), highest = scale.band(values_[block].maxCoeff());
  std::vector<Vec2> corners;
  for (Index i = 0; i < outline.cols(); ++i) corners.push_back(view(outline.col(i)));
  paths[static_cast<std::size_t>(lowest)].polygon(corners);

  const double pixels = (outline.rowwise().maxCoeff() - outline.rowwise().minCoeff()).norm() * view.scale;
  const std::vector<int> bands = bands_above(lowest, highest, pixels);
  std::vector<double> levels;
  for (const int band : bands) levels.push_back(scale.bounds()[static_cast<std::size_t>(band)]);
  const Points nodes = meshes_[block].nodes(outline.colwise() - start, centroids_[block]);
  const std::vector<Region> regions = superlevel_regions(meshes_[block], nodes, values_[block], levels);
  for (std::size_t k = 0; k < regions.size(); ++k)
    for (const std::vector<Vec2>& polygon : regions[k]) {
      corners.clear();
      for (const Vec2& x : polygon) corners.push_back(start_on_page + view.direction(x));
      paths[static_cast<std::size_t>(bands[k])].polygon(corners);
    }
}

}  // namespace ddacontact
