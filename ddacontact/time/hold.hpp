/// \file Rates of contacts taken out of velocities by rigid motions of the blocks.
#pragma once

#include <ddacontact/solver/coupled_solution.hpp>
#include <ddacontact/time/rigid_motions.hpp>
#include <polyfem/assembly/pattern_matrix.hpp>

#include <vector>

namespace ddacontact {

/// A contact whose gap's rate shall vanish.
struct HeldContact {
  AffineForm gap, slip;     ///< over the same unknowns in the same order; of them only coefficients matter
  bool tangential = false;  ///< the slip's rate shall vanish too
};

/// What normal impulses make friction do: shear impulse = rate * normal impulse + given.
struct HeldFriction {
  double rate = 0, given = 0;
};

/// Impulses, N s per m of thickness, and the change of all velocities that they make.
struct HeldJump {
  VectorXd velocity;
  VectorXd normal, shear;  ///< of every contact, on its gap and on its slip
  bool settled = true;     ///< friction agrees with the normal impulses
};

/// The matrix of a Hold with its factor: kept for the next one, whose contacts mostly join the same blocks.
struct HoldFactor {
  polyfem::PatternMatrix matrix;
  polyfem::Cholesky cholesky;
};

/// Contacts that are held. The rates of deforming blocks may contradict each other as far as rigid motions
/// go, so that impulses that move nothing would grow without end: springs that resist what is left of the
/// rates find motions of least squares instead, in rounds, each on what the last one left.
class Hold {
 public:
  /// \param[in] blocks      prepared for the shapes meant; they must stay so
  /// \param[in] negligible  a velocity that need not be found, m/s
  /// \param[in,out] factor  of this one's, as long as it lives
  Hold(const BlockSystem& blocks, const std::vector<HeldContact>& contacts, double negligible,
       HoldFactor& factor);

  /// The change of velocity, a rigid motion of each block of least kinetic energy, that leaves the least
  /// squares of the rates that velocities v have, and of those that it changes about a millionth, or what
  /// negligible velocities make. Shortened where it would make energy.
  VectorXd jump(const VectorXd& v) const;
  /// The impulses of a jump, and what they move with the friction that they make, one for every contact.
  /// \param[in] rough  a ten-thousandth of the rates may be left
  HeldJump with_friction(const VectorXd& jump, const std::vector<HeldFriction>& friction,
                         bool rough = false) const;

 private:
  /// Of every contact that is held in this direction; 0 of others.
  struct Rates {
    VectorXd gap, slip;
  };
  static Rates zeros(std::size_t n);
  static Rates rates(const std::vector<HeldContact>& forms, const VectorXd& v);
  void factorize();
  /// False: friction was not found to its tolerance in a round.
  bool take_out(Rates& left, const std::vector<HeldFriction>& friction, bool rough, VectorXd& q,
                Rates& impulses) const;

  const BlockSystem& blocks_;
  const std::vector<HeldContact>& contacts_;
  RigidMotions motions_;
  double negligible_;                         ///< of the norm of coefficients of motions_
  std::vector<HeldContact> of_coefficients_;  ///< contacts_ as forms of the coefficients of motions_
  Rates stiffness_;                           ///< of springs against the rates
  HoldFactor& factor_;                        ///< of 1 + sum of stiffness * gradient * gradient^T
};

}  // namespace ddacontact
