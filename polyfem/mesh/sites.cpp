#include <polyfem/mesh/sites.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/domain_rows.hpp>
#include <polyfem/mesh/site_grid.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace polyfem {

namespace {

constexpr double rows_per_site = 5;

double row_spacing(const PointsRef& domain, double n_sites) {
  return std::sqrt(std::abs(signed_area(domain)) / n_sites) / rows_per_site;
}

/// Uniform in [0, 1): the distributions of <random> differ from library to library.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Picks pieces of rows with a probability in proportion to their lengths.
class PiecePicker {
 public:
  explicit PiecePicker(const DomainRows& rows) : rows_(rows) {
    double length = 0;
    for (const RowPiece& piece : rows.pieces) ends_.push_back(length += piece.x_end - piece.x_begin);
  }
  const RowPiece& operator()(double fraction) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end() - 1, fraction * ends_.back());
    return rows_.pieces[found - ends_.begin()];
  }

 private:
  const DomainRows& rows_;
  std::vector<double> ends_;
};

/// A point of the domain in the strip around a piece of a row; after many tries one on the row itself.
Vec2 point_near(const RowPiece& piece, double height, const PointsRef& domain, std::mt19937_64& random) {
  constexpr int most_tries = 100;
  Vec2 on_row;
  for (int tries = 0; tries < most_tries; ++tries) {
    on_row << piece.x_begin + uniform(random) * (piece.x_end - piece.x_begin), piece.y;
    const Vec2 point = on_row + Vec2(0, (uniform(random) - 0.5) * height);
    if (contains(domain, point)) return point;
  }
  return on_row;
}

}  // namespace

Points random_sites(const PointsRef& domain, int n_sites, std::uint64_t seed) {
  const DomainRows rows = domain_rows(domain, row_spacing(domain, n_sites));
  const PiecePicker pick(rows);
  std::mt19937_64 random(seed);
  Points sites(2, n_sites);
  for (Index i = 0; i < n_sites; ++i)
    sites.col(i) = point_near(pick(uniform(random)), rows.height, domain, random);
  return sites;
}

Points lloyd_step(const PointsRef& domain, const Points& sites) {
  const double spacing = row_spacing(domain, static_cast<double>(sites.cols()));
  const SiteGrid grid(sites, domain.rowwise().minCoeff(), domain.rowwise().maxCoeff());
  Points moments = Points::Zero(2, sites.cols());
  VectorXd weights = VectorXd::Zero(sites.cols());
  // In a very long domain the cells lie side by side, and this many samples of each row are enough.
  const double most_samples = rows_per_site * rows_per_site * static_cast<double>(sites.cols());
  for (const RowPiece& piece : domain_rows(domain, spacing).pieces) {
    const double length = piece.x_end - piece.x_begin;
    const int n = static_cast<int>(std::clamp(std::round(length / spacing), 1.0, most_samples));
    for (int k = 0; k < n; ++k) {
      const Vec2 sample(piece.x_begin + (k + 0.5) / n * length, piece.y);
      const int site = grid.nearest(sample);
      moments.col(site) += length / n * sample;
      weights[site] += length / n;
    }
  }
  Points moved = sites;
  for (Index i = 0; i < sites.cols(); ++i) {
    if (weights[i] <= 0) continue;
    const Vec2 centroid = moments.col(i) / weights[i];
    if (contains(domain, centroid)) moved.col(i) = centroid;
  }
  return moved;
}

}  // namespace polyfem
