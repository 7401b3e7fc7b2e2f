#include <ddacontact/time/run_warnings.hpp>

#include <ddacontact/time/caught_corners.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// Of a block's size, in one substep.
constexpr double far_part = 0.1;
/// Of fewer blocks in contact, most is said of too few.
constexpr int least_blocks = 4;
/// The largest strain of the edges of an outline, as a ratio.
double edge_strain(const PointsRef& reference, const PointsRef& outline) {
  double largest = 0;
  for (Index k = 0, n = outline.cols(); k < n; ++k) {
    const Index next = k + 1 < n ? k + 1 : 0;
    const double length = (reference.col(next) - reference.col(k)).norm(),
                 now = (outline.col(next) - outline.col(k)).norm();
    largest = std::max(largest, std::abs(now - length) / length);
  }
  return largest;
}

}  // namespace

void RunWarnings::Sighting::add(double value, int of_block, double time) {
  if (substeps++ == 0) first_time = time;
  if (value <= largest) return;
  largest = value;
  block = of_block;
}

void RunWarnings::note(const SeenStep& step) {
  const int n_blocks = step.blocks.n_blocks();
  std::vector<char> touches(n_blocks, 0), slides(n_blocks, 0), changes(n_blocks, 0);
  for (const Contact& contact : step.contacts) {
    if (contact.start_state == ContactState::open && !contact.closed()) continue;
    const bool differs = !step.is_first && contact.start_state != contact.history.state;
    // Below the default tolerance of penetration sliding is not told from rest.
    const bool slipped =
        step.has_velocities && contact.closed() &&
        std::abs(contact.slip_change) > standard_defaults.penetration_tolerance * contact.size &&
        carries_waves(step.blocks, contact, step.dt);
    for (int b : contact.pair.blocks()) {
      touches[b] = 1;
      if (differs) changes[b] = 1;
      if (slipped) slides[b] = 1;
    }
  }
  int n_touch = 0, n_change = 0;
  std::pair furthest{far_part, -1}, strain{large_strain, -1};  // with the block whose it is
  for (int b = 0; b < n_blocks; ++b) {
    if (!step.blocks.is_movable(b) || !touches[b]) continue;
    const int whole = step.in_whole.empty() ? b : step.in_whole[b];
    ++n_touch;
    if (changes[b]) ++n_change;
    slid[whole] += slides[b];
    unsteady[whole] += slides[b] && changes[b];
    const Block& block = step.blocks.block(b);
    const double of_block =
        edge_strain(block.reference().leftCols(block.n_vertices()), block.outline(step.state));
    strain = std::max(strain, std::pair(of_block, whole));
    furthest = std::max(furthest, std::pair(block.furthest_vertex(step.d) / block.size(), whole));
  }
  if (furthest.second >= 0) far.add(furthest.first, furthest.second, step.time);
  if (strain.second >= 0) strained.add(strain.first, strain.second, step.time);
  if (n_touch >= least_blocks && 2 * n_change > n_touch)
    changed.add(static_cast<double>(n_change) / n_touch, -1, step.time);
  // A static step starts from rest: what held a corner before and does no more has no effect.
  if (!step.has_velocities) caught = {};
  if (const int b = find_caught_block(step.blocks, step.state, step.contacts); b >= 0)
    caught.add(1, step.in_whole.empty() ? b : step.in_whole[b], step.time);
}

}  // namespace ddacontact
