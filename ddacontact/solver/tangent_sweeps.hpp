/// \file The matrix of a tangent and a sweep forth and back over its blocks that is nearly its inverse.
#pragma once

#include <ddacontact/solver/contact_side.hpp>
#include <ddacontact/solver/coupled_solution.hpp>

#include <vector>

namespace ddacontact {

/// K = A + springs that act + couplings, over packed vectors of BlockGroups, with the preconditioner
/// M = (D + L) D^-1 (D + U): D is what of K is within blocks, L and U what couples a block with earlier and
/// later ones of its group. Both are had in one go, since most products with K are those of M. Groups are
/// shared by threads. In single precision: what solves to a few digits waits for memory.
class TangentSweeps {
 public:
  using Vector = Eigen::VectorXf;

  /// Takes the matrices of the problem and the springs. False: the inverse of a block is not finite.
  /// \param[in] groups     of the problem and these contacts
  /// \param[in] active     see active_springs
  /// \param[in] couplings  each of the gap and the slip of one contact
  [[nodiscard]] bool set(FrictionProblem& problem, const BlockGroups& groups,
                         const std::vector<ContactTerm>& contacts, const std::vector<unsigned char>& active,
                         const std::vector<Coupling>& couplings);

  /// x = M^-1 b, y = K x.
  void apply(const Vector& b, Vector& x, Vector& y);

 private:
  /// A SideEntry: the coefficients of the gap, then those of the slip.
  struct Entry {
    Eigen::Array<float, 4, 1, Eigen::DontAlign> coefficients;
    int place;
  };
  /// Of a gap and a slip, or their changes.
  struct Forces {
    float gap = 0, slip = 0;
  };
  /// Forces by changes of gap and slip.
  struct Law {
    float normal = 0, shear = 0, mixed = 0;
    Forces operator()(const Forces& change) const {
      return {normal * change.gap, shear * change.slip + mixed * change.gap};
    }
  };
  /// What a contact is for one of its blocks.
  struct Side {
    int slot, slot_of_other;  ///< where one block leaves forces for the other
    int n_entries;
    Law law;
  };
  /// Sides of a block of one kind, one after the other.
  struct Sides {
    int first = 0, count = 0, first_entry = 0;
  };
  struct Block {
    Sides earlier, later, apart;  ///< the other block is before or after this one in its group, or in another
    std::size_t inverse;
  };

  bool set_block(FrictionProblem& problem, const std::vector<ContactTerm>& contacts, int block);
  /// Gives the other blocks of the sides the forces by which they resist x of this one.
  void leave_forces(const Sides& sides, const float* x);
  /// y += factor * those that the other blocks left.
  void add_forces(const Sides& sides, float factor, float* y) const;
  void sweep(int group, const Vector& b, Vector& x, Vector& y);
  void add_apart(int group, Vector& y) const;

  const BlockGroups* groups_ = nullptr;
  std::vector<Law> laws_;  ///< of all contacts
  std::vector<Block> blocks_;
  std::vector<Side> sides_;
  std::vector<Entry> entries_;
  std::vector<float> inverses_;
  std::vector<Forces> forces_;  ///< slots, one for each neighbour of a block
};

}  // namespace ddacontact
