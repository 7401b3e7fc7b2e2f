/// \file Frames of random numbers, the same for the same seed.
#pragma once

#include <ddacontact/output/frame.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <cstring>

namespace support {

using namespace ddacontact;

inline Points random_points(Index n, std::mt19937& random) {
  return Points::NullaryExpr(2, n, [&] { return uniform(-1e-3, 1e-3, random); });
}

/// Blocks with 3 to 9 corners far from the origin, of two materials, with every field and some contacts.
inline Frame random_frame(int n_blocks, unsigned seed) {
  std::mt19937 random(seed);
  Frame frame;
  frame.step = static_cast<long>(random() % 1000);
  frame.time = uniform(0, 10, random);
  frame.material_names = {"rock, \"hard\"", "", "soil & <clay>\n"};
  for (double young : {35e9, 1e6, 7e5})
    frame.elasticity.push_back(polyfem::elasticity_matrix(young, 0.3, polyfem::Plane::strain));
  for (int b = 0; b < n_blocks; ++b) {
    const Index first = frame.position.cols();
    const Points outline = random_convex_polygon(3 + static_cast<int>(random() % 7), random);
    frame.blocks.push_back({static_cast<int>(first), static_cast<int>(outline.cols())});
    frame.materials.push_back(static_cast<int>(random() % 3));
    frame.position.conservativeResize(2, first + outline.cols());
    frame.position.rightCols(outline.cols()) = outline.colwise() + Vec2(3.4e6 + 2 * b, -1e3);
  }
  for (int b = 0; b < n_blocks; ++b) frame.add_outline_cell(b);
  const Index n = frame.position.cols();
  frame.displacement = random_points(n, random);
  frame.velocity = random_points(n, random);
  frame.strain_displacement = random_points(n, random);
  frame.stress_offset.setZero(3, n_blocks);
  frame.mean_stress = Tensors::NullaryExpr(3, n_blocks, [&] { return uniform(-1e5, 1e5, random); });
  for (const BlockField& field : block_fields())
    frame.block_values[field.name] = VectorXd::NullaryExpr(n_blocks, [&] { return uniform(-4, 4, random); });
  frame.velocity.col(0) << -0.0, 5e-324;
  for (int k = 0; k < 2 * n_blocks; ++k) {
    FrameContact contact;
    contact.vertex_block = static_cast<int>(random() % static_cast<unsigned>(n_blocks));
    contact.edge_block = static_cast<int>(random() % static_cast<unsigned>(n_blocks));
    contact.position = frame.position.col(k % n);
    contact.normal = random_direction(random);
    contact.gap = uniform(-1e-6, 1e-6, random);
    contact.normal_force = uniform(-10, 1e6, random);
    contact.shear_force = uniform(-1e5, 1e5, random);
    contact.state = static_cast<ContactState>(k % 4);
    frame.contacts.push_back(contact);
  }
  return frame;
}

/// Bit for bit, signs of zeros too.
inline bool same(const MatrixXd& a, const MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.size() == 0 ||
          std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0);
}

}  // namespace support
