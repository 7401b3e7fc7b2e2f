#include <ddacontact/output/bolt_view.hpp>

#include <cmath>

namespace ddacontact {

namespace {

/// A force that yields is at its bound up to round-off, of positions too: the elongation is their difference.
bool reaches(double force, double bound) {
  constexpr double round_off = 1e-9;
  return std::abs(force) >= (1 - round_off) * bound;
}

}  // namespace

BoltView::BoltView(const Bolt& bolt, const BlockSystem& blocks, const BlockState& state)
    : bolt_(bolt), bears_(bolt.installed) {
  if (!bears_) return;
  numbers_ = state.bolts.segment(bolt.numbers.first, bolt.numbers.count);
  of_rock_ = elongations(bolt, blocks, state);
  forces_ = bolt_forces(bolt, numbers_, of_rock_);
}

double BoltView::elongation(int segment) const {
  if (!bears_) return 0;
  const double slips = bolt_.is_grouted() ? forces_.slip[segment + 1] - forces_.slip[segment] : 0;
  return of_rock_[segment] + slips;
}

bool BoltView::slips(int node) const {
  return bolt_.is_grouted() && reaches(forces_.bond[node], bolt_.bond_strength * bolt_.bonded[node]);
}

const char* BoltView::state(int segment) const {
  if (!bears_) return "absent";
  if (is_torn(segment)) return "torn";
  if (reaches(forces_.axial[segment], bolt_.yield)) return "yield";
  if (forces_.axial[segment] < 0 && reaches(forces_.axial[segment], bolt_.buckling)) return "buckled";
  return slips(segment) || slips(segment + 1) ? "slip" : "elastic";
}

int BoltView::most_loaded() const {
  int most = -1;
  for (int k = 0; k < bolt_.n_segments(); ++k)
    if (bolt_.has_segment(k) && (most < 0 || std::abs(axial(k)) > std::abs(axial(most)))) most = k;
  return most;
}

}  // namespace ddacontact
