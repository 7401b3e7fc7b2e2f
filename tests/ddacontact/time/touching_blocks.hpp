/// \file Blocks with velocities that are rigid motions, and their contacts where they touch.
#pragma once

#include <ddacontact/contact/kinematics.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

namespace support {

struct TouchingBlocks {
  BuiltScene built;
  const BlockSystem& blocks;
  const BlockState& state;
  VectorXd v;
  std::vector<ImpactContact> contacts;

  explicit TouchingBlocks(const std::vector<BlockDescription>& of, double friction = 0,
                          double restitution = 0, const std::vector<double>& densities = {2000, 2000, 2000})
      : built(build(scene(of, densities))),
        blocks(built.stepper->blocks()),
        state(built.stepper->state()),
        v(built.stepper->state().velocity) {
    for (int a = 0; a < blocks.n_blocks(); ++a)
      for (int b = 0; b < blocks.n_blocks(); ++b)
        if (a != b) add_contacts(a, b, friction, restitution);
  }

  static Scene scene(const std::vector<BlockDescription>& of, const std::vector<double>& densities) {
    Scene scene = rock_scene(0.01, 1);
    scene.materials.resize(densities.size(), scene.materials[0]);
    for (std::size_t m = 0; m < densities.size(); ++m) {
      scene.materials[m].name = std::to_string(m);
      scene.materials[m].density = densities[m];
    }
    scene.blocks = of;
    return scene;
  }

  Points outlines() const { return blocks.reference(); }
  Vec2 vertex(int b, int k) const {
    const Range& of = blocks.block(b).vertices();
    return outlines().col(of.first + k % of.count);
  }
  Vec2 centroid(int b) const { return blocks.block(b).centroid(state); }

  /// Vertices of a on edges of b; of two edges at a corner the one that faces a.
  void add_contacts(int a, int b, double friction, double restitution) {
    for (int i = 0; i < blocks.block(a).n_vertices(); ++i) {
      int facing = -1;
      double most = 0;
      for (int e = 0; e < blocks.block(b).n_vertices(); ++e) {
        const Vec2 j = vertex(b, e), along = (vertex(b, e + 1) - j).normalized(), x = vertex(a, i) - j;
        const double s = x.dot(along), length = (vertex(b, e + 1) - j).norm();
        if (std::abs(cross(along, x)) > 1e-9 || s < -1e-9 || s > length + 1e-9) continue;
        const double faces = -cross(along, centroid(a) - vertex(a, i));
        if (faces > most) {
          most = faces;
          facing = e;
        }
      }
      if (facing >= 0) add_contact(a, i, b, facing, friction, restitution);
    }
  }
  void add_contact(int a, int i, int b, int e, double friction, double restitution) {
    const VertexEdgePositions point{vertex(a, i), vertex(b, e), vertex(b, e + 1)};
    const MovingVertexEdge motion{{point},
                                  blocks.block(a).vertex_map(i),
                                  blocks.block(b).vertex_map(e),
                                  blocks.block(b).vertex_map((e + 1) % blocks.block(b).n_vertices()),
                                  {}};
    ImpactContact contact;
    contact.gap = motion.form(gap_form(point));
    contact.slip = motion.form(slip_form(point, edge_fraction(point.i, point.j, point.k)));
    contact.friction = friction;
    contact.restitution = restitution;
    contacts.push_back(contact);
  }

  void set_velocity(int b, const Vec3& rigid) {
    const Block& of = blocks.block(b);
    v.segment(of.unknowns().first, of.n_unknowns()) = of.rigid_modes(state) * rigid;
  }
  JumpReport jump(double least_approach = 0) const {
    return impact(blocks, state, contacts, v, least_approach);
  }
  RigidVelocity velocity(int b, const VectorXd& of) const {
    return rigid_velocity(blocks.block(b), state, of);
  }

  double energy(const VectorXd& of) const {
    double sum = 0;
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      const Range& u = blocks.block(b).unknowns();
      const VectorXd part = of.segment(u.first, u.count);
      sum += part.dot(blocks.block(b).mass() * part) / 2;
    }
    return sum;
  }
  /// And about the origin.
  Vec3 momentum(const VectorXd& of) const {
    Vec3 sum = Vec3::Zero();
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      const Block& block = blocks.block(b);
      const RigidVelocity rigid = velocity(b, of);
      const Vec2 p = block.mass_total() * rigid.linear;
      sum += Vec3(p.x(), p.y(), cross(centroid(b), p) + inertia(b) * rigid.angular);
    }
    return sum;
  }
  double inertia(int b) const {
    const VectorXd turning = blocks.block(b).rotation(state);
    return turning.dot(blocks.block(b).mass() * turning);
  }

  /// What every outcome must satisfy: cone, energy and its accounts; nothing approaches.
  void check(const JumpReport& report, double tolerance) const {
    double fastest = 0;
    for (const ImpactContact& contact : contacts)
      fastest = std::max({fastest, std::abs(contact.gap.change(v)), std::abs(contact.slip.change(v))});
    const VectorXd after = v + report.jump;
    EXPECT_LE(energy(after), energy(v) * (1 + 1e-12));
    EXPECT_NEAR(report.normal_loss + report.friction_loss, energy(v) - energy(after), 1e-10 * energy(v));
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto [N, T] = report.impulses[c];
      if (!contacts[c].bonded) {
        EXPECT_GE(N, 0);
        EXPECT_LE(std::abs(T), contacts[c].friction * N * (1 + 1e-12));
      }
      if (report.settled) {
        EXPECT_GE(contacts[c].gap.change(after), -tolerance * fastest);
      }
    }
  }
};

inline const BlockDescription floor_block = block(rectangle(-50, -1, 100, 1), true);

inline BlockDescription of_material(int material, BlockDescription described) {
  described.material = material;
  return described;
}

/// Courses of bricks on a floor, each over the joints of the one below: most contacts say what others say.
inline std::vector<BlockDescription> wall(int courses, int bricks) {
  std::vector<BlockDescription> blocks{floor_block};
  for (int row = 0; row < courses; ++row)
    for (int k = 0; k < bricks; ++k)
      blocks.push_back(of_material((row + k) % 3, block(rectangle(2 * k + row % 2, row, 2, 1))));
  return blocks;
}

}  // namespace support
