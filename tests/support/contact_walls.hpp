/// \file Walls, stacks and arches of quadrilateral blocks as contact problems: what the contact solver is
/// tested and measured with. Motions are small, so rows and contacts stay what they are at the start.
#pragma once

#include <ddacontact/solver/contact_problem.hpp>

#include <array>
#include <vector>

namespace support {

using ddacontact::ContactProblem;
using ddacontact::MatrixXd;
using ddacontact::Vec2;
using ddacontact::VectorXd;

/// A convex quadrilateral block, counterclockwise.
struct Quadrilateral {
  std::array<Vec2, 4> vertices;
  bool fixed = false;
  double density = 2500;  ///< kg/m^3
};

/// A wall of side x side bricks of 1 m x .5 m in running bond on a fixed base: every second course has half
/// bricks at its ends.
std::vector<Quadrilateral> wall(int side);
/// n square blocks of 1 m on each other on a fixed base.
std::vector<Quadrilateral> stack(int n);
/// A half ring of n wedges between two fixed springers. Radii in m.
std::vector<Quadrilateral> arch(int n, double inner_radius, double outer_radius);

/// Blocks that fall under gravity from rest, step by step.
class QuadrilateralSystem {
 public:
  /// \param[in] modulus  Young's modulus, Pa. \param[in] friction  tan(phi)
  QuadrilateralSystem(std::vector<Quadrilateral> blocks, double modulus, double friction);

  int n_blocks() const { return static_cast<int>(numbers_.size()); }
  /// The contact problem of a step of this length (s), with the impulses of the last step.
  ContactProblem problem(double dt) const;
  /// Takes over what a solution says. \param[in] z  its velocities
  void advance(const ContactProblem& solved, const VectorXd& z, double dt);

 private:
  struct Block {
    Quadrilateral outline;
    Vec2 centre;
    VectorXd mass, frequency2;  ///< of the 8 unknowns; w^2 of the modes, 0 of rigid motion
    MatrixXd shape;             ///< 8 x 8: velocities of the vertices by the unknowns
    VectorXd velocity, displacement;
  };
  struct Contact {
    int one, other;  ///< blocks
    double gap;      ///< m, at the start of the step
    VectorXd normal[2], shear[2];
    ddacontact::NormalAndShear impulse;
  };
  void find_contacts(int one, int other);

  std::vector<Block> blocks_;
  std::vector<int> numbers_;  ///< of the blocks that move
  std::vector<Contact> contacts_;
  double friction_;
};

}  // namespace support
