/// \file Frames of concave blocks and blocks of several cells.
#pragma once

#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <tests/ddacontact/output/random_frame.hpp>

#include <vector>

namespace support {

/// Adds a block of these points, the first `n_vertices` of which are its outline, with these cells.
inline void add_cells(Frame& frame, const std::vector<Vec2>& points, int n_vertices,
                      const std::vector<std::vector<int>>& cells, const polyfem::Basis& basis) {
  const int block = frame.n_blocks(), first = static_cast<int>(frame.position.cols());
  frame.blocks.push_back({first, n_vertices});
  frame.materials.push_back(block % 2);
  frame.position.conservativeResize(2, first + static_cast<Index>(points.size()));
  for (std::size_t p = 0; p < points.size(); ++p)
    frame.position.col(first + static_cast<Index>(p)) = points[p];
  for (const std::vector<int>& corners : cells) {
    const int n = static_cast<int>(corners.size());
    // Every other cell has an elasticity that is none of a material.
    frame.cells.push_back({block,
                           {static_cast<int>(frame.corner_points.size()), n},
                           frame.cells.size() % 2 == 0 ? block % 2 : 2,
                           &basis});
    for (int corner : corners) frame.corner_points.push_back(first + corner);
  }
}

/// A square, an L, a U that does not hold its centroid and has a vertex on an edge, and a square of five
/// cells with nodes on edges and points inside, one cell concave. No fields.
inline Frame cell_frame() {
  Frame frame;
  frame.step = 3;
  frame.time = 0.5;
  frame.material_names = {"rock", "soil"};
  for (double young : {35e9, 1e6, 7e5})
    frame.elasticity.push_back(polyfem::elasticity_matrix(young, 0.3, polyfem::Plane::strain));
  frame.position.resize(2, 0);
  add_cells(frame, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 4, {{0, 1, 2, 3}}, polyfem::wachspress);
  add_cells(frame, {{2, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2}, {2, 2}}, 6, {{0, 1, 2, 3, 4, 5}},
            polyfem::mean_value);
  add_cells(frame, {{5, 0}, {6.5, 0}, {8, 0}, {8, 3}, {7, 3}, {7, 0.5}, {6, 0.5}, {6, 3}, {5, 3}}, 9,
            {{0, 1, 2, 3, 4, 5, 6, 7, 8}}, polyfem::mean_value);
  add_cells(frame, {{9, 0}, {10, 0}, {11, 0}, {11, 2}, {10, 2}, {9, 2}, {10.5, 1}, {9.5, 1}}, 6,
            {{0, 1, 6, 7}, {6, 4, 5, 7}, {0, 7, 5}, {1, 2, 3, 4, 6}}, polyfem::mean_value);
  return frame;
}

/// The same with fields at random.
inline Frame random_cell_frame(unsigned seed) {
  std::mt19937 random(seed);
  Frame frame = cell_frame();
  frame.displacement = random_points(frame.position.cols(), random);
  frame.velocity = random_points(frame.position.cols(), random);
  frame.strain_displacement = random_points(static_cast<Index>(frame.corner_points.size()), random);
  const auto stress = [&] { return uniform(-1e5, 1e5, random); };
  frame.stress_offset = Tensors::NullaryExpr(3, frame.n_cells(), stress);
  frame.mean_stress = Tensors::NullaryExpr(3, frame.n_blocks(), stress);
  return frame;
}

/// The same with displacements, velocities and strains of one linear field; `offset` Pa times the number of
/// the cell is added to its stress.
inline Frame linear_cell_frame(const Mat2& gradient, const Vec3& offset) {
  Frame frame = cell_frame();
  const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  frame.displacement = frame.velocity = gradient * frame.position;
  frame.strain_displacement = frame.displacement(Eigen::all, frame.corner_points);
  frame.stress_offset.resize(3, frame.n_cells());
  frame.mean_stress.setZero(3, frame.n_blocks());
  VectorXd areas = VectorXd::Zero(frame.n_blocks());
  for (int c = 0; c < frame.n_cells(); ++c) {
    const FrameCell& cell = frame.cells[c];
    const std::span<const int> points = frame.corners(c);
    Points corners(2, cell.corners.count);
    for (int k = 0; k < cell.corners.count; ++k) corners.col(k) = frame.position.col(points[k]);
    const double area = polyfem::signed_area(corners);
    frame.stress_offset.col(c) = c * offset;
    frame.mean_stress.col(cell.block) += area * (frame.elasticity[cell.elasticity] * strain + c * offset);
    areas[cell.block] += area;
  }
  for (int b = 0; b < frame.n_blocks(); ++b) frame.mean_stress.col(b) /= areas[b];
  return frame;
}

}  // namespace support
