#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <set>
#include <utility>

using namespace polyfem;

namespace {

struct Domain {
  const char* name;
  Points polygon;
  bool convex;
};

std::ostream& operator<<(std::ostream& out, const Domain& domain) {
  return out << domain.name;
}

const Points far_parallelogram = support::polygon_of(
    {{1e6, 1e6}, {1e6 + 2000, 1e6 + 1000}, {1e6 + 1600, 1e6 + 1800}, {1e6 - 400, 1e6 + 800}});

const Domain domains[] = {
    {"Rectangle", support::rectangle(100, 50), true},
    {"ClockwiseRectangle", support::rectangle(3e-3, 1e-3).rowwise().reverse(), true},
    {"Triangle", support::polygon_of({{0, 0}, {4, 0}, {1, 3}}), true},
    {"Thin", support::rectangle(1000, 1), true},
    {"ThinDiagonal", support::polygon_of({{0, 0}, {1000, 1000}, {999, 1001}}), true},
    {"FarParallelogram", far_parallelogram, true},
    {"LShape", support::l_shape(), false},
    {"Star", support::star(5), false},
};

double turn_of(const Points& cell) {
  return least_turn(static_cast<int>(cell.cols()), [&](int k) -> Vec2 { return cell.col(k); });
}

void expect_cells(const PolygonMesh& mesh, const Domain& domain) {
  double sum = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    sum += signed_area(mesh.outline(c));
    EXPECT_EQ(find_non_convex_corner(mesh.outline(c), 1e-3), std::nullopt) << c;
    if (domain.convex) {
      EXPECT_GT(turn_of(mesh.outline(c)), std::sin(3 * 3.14 / 180)) << c;
    }
  }
  EXPECT_NEAR(sum / std::abs(signed_area(domain.polygon)), 1, 1e-12);
}

/// Inner edges have a cell on each side, in opposite directions.
void expect_shared_edges(const PolygonMesh& mesh) {
  std::set<std::pair<int, int>> directed;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto cell = mesh.cell(c);
    for (std::size_t k = 0; k < cell.size(); ++k)
      EXPECT_TRUE(directed.insert({cell[k], cell[(k + 1) % cell.size()]}).second);
  }
  std::set<std::pair<int, int>> single;
  for (const auto& [first, second] : directed)
    if (!directed.contains({second, first})) single.insert({first, second});
  std::set<std::pair<int, int>> reported;
  for (const auto& [first, second] : boundary_edges(mesh)) reported.insert({first, second});
  EXPECT_EQ(single, reported);
}

/// The outline is one closed chain that passes every corner of the domain; between two corners all its edges
/// are collinear.
void expect_outline(const PolygonMesh& mesh, const Points& domain) {
  Points outline = domain;
  if (signed_area(outline) < 0) outline = domain.rowwise().reverse();
  const Index n = outline.cols();
  const double size = (outline.rowwise().maxCoeff() - outline.rowwise().minCoeff()).norm();
  const double round_off = 4e-16 * (size + outline.cwiseAbs().maxCoeff());
  std::map<int, int> next;
  for (const auto& [first, second] : boundary_edges(mesh)) EXPECT_TRUE(next.insert({first, second}).second);
  int vertex = -1;
  for (const auto& [first, second] : next)
    if (mesh.vertices.col(first) == outline.col(0)) vertex = first;
  ASSERT_GE(vertex, 0);
  std::size_t n_passed = 0;
  for (Index k = 0; k < n; ++k) {
    const Vec2 a = outline.col(k), b = outline.col((k + 1) % n), along = (b - a).normalized();
    for (double last = -1; n_passed <= next.size() && Vec2(mesh.vertices.col(vertex)) != b; ++n_passed) {
      const Vec2 x = mesh.vertices.col(vertex);
      EXPECT_LE(std::abs(cross(along, x - a)), round_off);
      EXPECT_GT(along.dot(x - a), last);
      last = along.dot(x - a);
      vertex = next.at(vertex);
    }
  }
  EXPECT_EQ(n_passed, next.size());
  EXPECT_EQ(Vec2(mesh.vertices.col(vertex)), Vec2(outline.col(0)));
}

void expect_each_vertex_once(const PolygonMesh& mesh) {
  std::set<int> used(mesh.indices.begin(), mesh.indices.end());
  EXPECT_EQ(static_cast<Index>(used.size()), mesh.vertices.cols());
  std::set<std::pair<double, double>> positions;
  for (const auto x : mesh.vertices.colwise()) positions.insert({x.x(), x.y()});
  EXPECT_EQ(static_cast<Index>(positions.size()), mesh.vertices.cols());
}

class VoronoiOfDomain : public testing::TestWithParam<std::tuple<Domain, int>> {};
INSTANTIATE_TEST_SUITE_P(Domains, VoronoiOfDomain,
                         testing::Combine(testing::ValuesIn(domains), testing::Values(1, 2, 10, 1000)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + std::to_string(std::get<1>(test.param));
                         });

TEST_P(VoronoiOfDomain, IsASoundMeshOfIt) {
  const auto& [domain, n_cells] = GetParam();
  for (std::uint64_t seed = 0; seed < (n_cells < 1000 ? 30u : 3u); ++seed) {
    SCOPED_TRACE(seed);
    const PolygonMesh mesh = voronoi(domain.polygon, {.n_cells = n_cells, .seed = seed});
    if (domain.convex)
      EXPECT_EQ(mesh.n_cells(), n_cells);
    else
      EXPECT_GE(mesh.n_cells(), n_cells);
    expect_cells(mesh, domain);
    expect_shared_edges(mesh);
    ASSERT_NO_FATAL_FAILURE(expect_outline(mesh, domain.polygon));
    expect_each_vertex_once(mesh);
  }
}

TEST(Voronoi, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
  const PolygonMesh first = voronoi(support::star(5), {.seed = 7}),
                    again = voronoi(support::star(5), {.seed = 7});
  EXPECT_EQ(first.vertices, again.vertices);
  EXPECT_EQ(first.indices, again.indices);
  EXPECT_EQ(first.offsets, again.offsets);
  const PolygonMesh other = voronoi(support::star(5), {.seed = 8});
  EXPECT_NE(first.indices, other.indices);
}

TEST(Voronoi, LeavesNoShortEdgeInARectangle) {
  for (const double smallest : {0.05, 0.1, 0.2})
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      const PolygonMesh mesh =
          voronoi(support::rectangle(20, 10), {.n_cells = 80, .seed = seed, .smallest_edge = smallest});
      const double limit = smallest * std::sqrt(200. / 80);
      for (int c = 0; c < mesh.n_cells(); ++c) {
        const Points cell = mesh.outline(c);
        for (Index k = 0; k < cell.cols(); ++k)
          EXPECT_GE((cell.col((k + 1) % cell.cols()) - cell.col(k)).norm(), limit * (1 - 1e-9));
      }
    }
}

TEST(Voronoi, CollapsesLittleEvenWithoutLloydsMethod) {
  for (const double smallest : {0.0, 0.1, 0.3})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const PolygonMesh mesh = voronoi(
          support::l_shape(), {.n_cells = 100, .seed = seed, .lloyd_steps = 0, .smallest_edge = smallest});
      int n_short = 0;
      for (int c = 0; c < mesh.n_cells(); ++c) {
        const Points cell = mesh.outline(c);
        EXPECT_GT(turn_of(cell), 1e-3);
        for (Index k = 0; k < cell.cols(); ++k)
          n_short += (cell.col((k + 1) % cell.cols()) - cell.col(k)).norm() < smallest * std::sqrt(3. / 100);
      }
      EXPECT_LE(n_short, smallest > 0.2 ? 20 : 4) << smallest << ' ' << seed;
    }
}

TEST(Voronoi, BendsCornersThatRandomSitesLeaveStraight) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PolygonMesh mesh = voronoi(support::rectangle(1, 1),
                                     {.n_cells = 100, .seed = seed, .lloyd_steps = 0, .smallest_edge = 0});
    for (int c = 0; c < mesh.n_cells(); ++c) EXPECT_GT(turn_of(mesh.outline(c)), 0.05) << seed;
  }
}

TEST(Voronoi, KeepsVerticesExactlyOnHorizontalAndVerticalEdges) {
  const double left = -0.7, right = 3.1, bottom = 1e6 / 3, top = 1e6 / 3 + 0.7;
  const Points domain = support::polygon_of({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
  const PolygonMesh mesh = voronoi(domain);
  for (const auto& edge : boundary_edges(mesh)) {
    const Vec2 a = mesh.vertices.col(edge[0]), b = mesh.vertices.col(edge[1]);
    const bool vertical = a.x() == b.x() && (a.x() == left || a.x() == right);
    const bool horizontal = a.y() == b.y() && (a.y() == bottom || a.y() == top);
    EXPECT_TRUE(vertical || horizontal) << a.transpose() << ", " << b.transpose();
  }
}

TEST(Voronoi, BecomesMoreEvenWithLloydsMethod) {
  const auto spread = [](int lloyd_steps) {
    double squares = 0;
    const PolygonMesh mesh =
        voronoi(support::rectangle(1, 1), {.n_cells = 1000, .lloyd_steps = lloyd_steps, .smallest_edge = 0});
    for (int c = 0; c < mesh.n_cells(); ++c) squares += std::pow(1000 * signed_area(mesh.outline(c)) - 1, 2);
    return std::sqrt(squares / 1000);
  };
  EXPECT_NEAR(spread(0), 0.53, 0.05);  // of a Poisson-Voronoi tessellation
  EXPECT_LT(spread(3), 0.6 * spread(0));
  EXPECT_LT(spread(10), 0.8 * spread(3));
}

TEST(Voronoi, PrefersNoDirection) {
  // The structure tensor of edge directions, weighted by length, is that of an isotropic mesh.
  const PolygonMesh mesh = voronoi(support::rectangle(1, 1), {.n_cells = 5000});
  Mat2 tensor = Mat2::Zero();
  std::complex<double> fourth = 0;  // would see a square lattice
  double length = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    for (Index k = 0; k < cell.cols(); ++k) {
      const Vec2 edge = cell.col((k + 1) % cell.cols()) - cell.col(k);
      tensor += edge * edge.transpose() / edge.norm();
      fourth += edge.norm() * std::pow(std::complex(edge.x(), edge.y()) / edge.norm(), 4);
      length += edge.norm();
    }
  }
  EXPECT_LT((tensor / length - Mat2::Identity() / 2).norm(), 0.02);
  EXPECT_LT(std::abs(fourth) / length, 0.05);
}

TEST(Voronoi, OrdersCellsByRowsFromTheBottom) {
  const PolygonMesh mesh = voronoi(support::rectangle(10, 10), {.n_cells = 100});
  double last_row = -1, last_x = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Vec2 centroid = area_moments(mesh.outline(c)).centroid;
    const double row = std::floor(centroid.y());
    EXPECT_GE(row, last_row);
    if (row == last_row) {
      EXPECT_GT(centroid.x(), last_x);
    }
    last_row = row;
    last_x = centroid.x();
  }
}

TEST(Voronoi, CutsAtCornersOfTheDomainThatAreNearlyStraightAndForgetsStraightOnes) {
  const Points domain =
      support::polygon_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 2}, {1.5, 2 + 1e-6}, {0, 2}});
  const PolygonMesh mesh = voronoi(domain, {.n_cells = 1});
  EXPECT_EQ(mesh.n_cells(), 2);
  EXPECT_EQ(mesh.vertices.cols(), 5);
}

TEST(Voronoi, RefusesDomainsWithDefectsAndOptionsOutOfBounds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(voronoi(support::polygon_of({{0, 0}, {1, 0}})), Error);
  EXPECT_THROW(voronoi(support::polygon_of({{0, 0}, {1, 1}, {2, 2}})), Error);
  EXPECT_THROW(voronoi(support::polygon_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}})), Error);
  EXPECT_THROW(voronoi(support::polygon_of({{0, 0}, {nan, 2}, {2, 0}})), Error);
  EXPECT_THROW(voronoi(support::polygon_of({{0, 0}, {1, 0}, {1, 0}, {0, 1}})), Error);
  EXPECT_THROW(voronoi(support::rectangle(1e15, 1e-15)), Error);
  EXPECT_THROW(voronoi(support::rectangle(1e300, 1e300)), Error);
  const Points square = support::rectangle(1, 1);
  EXPECT_THROW(voronoi(square, {.n_cells = 0}), Error);
  EXPECT_THROW(voronoi(square, {.n_cells = 100'000'000}), Error);
  EXPECT_THROW(voronoi(square, {.lloyd_steps = -1}), Error);
  EXPECT_THROW(voronoi(square, {.smallest_edge = -0.1}), Error);
  EXPECT_THROW(voronoi(square, {.smallest_edge = 0.5}), Error);
  EXPECT_THROW(voronoi(square, {.smallest_edge = nan}), Error);
}

}  // namespace
