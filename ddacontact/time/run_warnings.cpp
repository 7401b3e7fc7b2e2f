#include <ddacontact/time/run_warnings.hpp>

#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/caught_corners.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cstdio>

namespace ddacontact {

namespace {

/// Of a block's size, in one substep.
constexpr double far = 0.1;
/// Of fewer blocks in contact, most is said of too few.
constexpr int least_blocks = 4;
/// Of all substeps: those in which contacts of most blocks change are no single events then.
constexpr double often = 0.1;
/// Of a block's size, in one substep: below the default tolerance of penetration sliding is not told from
/// rest.
constexpr double least_slip = 1e-6;
/// A first loading changes the contacts of a block a few times, a vibration every few substeps: changes, and
/// their part of the substeps in which the block slid.
constexpr long least_changes = 20;
constexpr double least_unsteady_part = 0.02;
/// Of the largest energy exchanged.
constexpr double large_rise = 0.01;
/// Stiffness-proportional damping of .3 of critical in the first mode of a block, over the time that a wave
/// takes through it: doc/decisions.md.
constexpr double damping_of_transit = 0.2;

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

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

void RunWarnings::look(const SeenStep& step) {
  const int n_blocks = step.blocks.n_blocks();
  std::vector<char> touches(n_blocks, 0), slides(n_blocks, 0), changes(n_blocks, 0);
  for (const Contact& contact : step.contacts) {
    const bool closed_before = contact.start_state != ContactState::open;
    if (!closed_before && !contact.closed()) continue;
    const bool changed = !step.is_first && contact.start_state != contact.history.state;
    const bool slipped = step.has_velocities && contact.closed() &&
                         std::abs(contact.slip_change) > least_slip * contact.size &&
                         carries_waves(step.blocks, contact, step.dt);
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block}) {
      touches[b] = 1;
      if (changed) changes[b] = 1;
      if (slipped) slides[b] = 1;
    }
  }
  int n_touch = 0, n_change = 0, furthest_block = -1, strained_block = -1;
  double furthest = 0, strain = large_strain;
  for (int b = 0; b < n_blocks; ++b) {
    if (!step.blocks.is_movable(b) || !touches[b]) continue;
    const int whole = step.in_whole.empty() ? b : step.in_whole[b];
    ++n_touch;
    if (changes[b]) ++n_change;
    if (slides[b]) {
      ++slid_[whole];
      if (changes[b]) ++unsteady_[whole];
    }
    const Block& block = step.blocks.block(b);
    const Range& vertices = block.vertices();
    const double of_block = edge_strain(block.reference().leftCols(vertices.count),
                                        step.state.position.middleCols(vertices.first, vertices.count));
    if (of_block > strain) {
      strain = of_block;
      strained_block = whole;
    }
    const double moved = block.furthest_vertex(step.d) / block.size();
    if (moved > furthest) {
      furthest = moved;
      furthest_block = whole;
    }
  }
  if (furthest > far) far_.add(furthest, furthest_block, step.time);
  if (strained_block >= 0) strained_.add(strain, strained_block, step.time);
  if (n_touch >= least_blocks && 2 * n_change > n_touch)
    changed_.add(static_cast<double>(n_change) / n_touch, -1, step.time);
  // A static step starts from rest: what held a corner before and does no more has no effect.
  if (!step.has_velocities) caught_ = {};
  if (const int b = find_caught_block(step.blocks, step.state, step.contacts); b >= 0)
    caught_.add(1, step.in_whole.empty() ? b : step.in_whole[b], step.time);
}

std::vector<std::string> RunWarnings::texts(const BlockSystem& blocks, long substeps,
                                            const EnergyLedger& energy) const {
  std::vector<std::string> texts;
  const std::string of_all = " of " + std::to_string(substeps) + " substeps";
  if (far_.substeps > 0)
    texts.push_back("a block in contact moved further than a tenth of its size in " +
                    std::to_string(far_.substeps) + of_all + ", first at " + figure(far_.first_time) +
                    " s; furthest block " + quoted(blocks.names[far_.block]) + ", by " +
                    figure(far_.largest) +
                    " of its size: results may depend on the step (a smaller 'time_step')");
  if (strained_.substeps > 0)
    texts.push_back("strains are large in " + std::to_string(strained_.substeps) + of_all + ", first at " +
                    figure(strained_.first_time) + " s; most in block " +
                    quoted(blocks.names[strained_.block]) + ", whose edges change by " +
                    figure(100 * strained_.largest) +
                    " %: elasticity is linear, for small strains (is 'young' right, with its unit?)");
  if (static_cast<double>(changed_.substeps) > often * static_cast<double>(substeps))
    texts.push_back("contacts of most blocks changed their state in " + std::to_string(changed_.substeps) +
                    of_all + ", first at " + figure(changed_.first_time) +
                    " s: results may depend on the step (a smaller 'time_step')");
  if (caught_.substeps > 0)
    texts.push_back("a step in a joint that is drawn flush held a corner in " +
                    std::to_string(caught_.substeps) + of_all + ", first at " + figure(caught_.first_time) +
                    " s, of block " + quoted(blocks.names[caught_.block]) +
                    ": blocks that should move may rest (contact = { corner_rounding = 0.003 })");
  const auto worst = std::max_element(unsteady_.begin(), unsteady_.end());
  const auto b = static_cast<int>(worst - unsteady_.begin());
  if (worst != unsteady_.end() && *worst >= least_changes &&
      static_cast<double>(*worst) >= least_unsteady_part * static_cast<double>(slid_[b]))
    texts.push_back(
        "block " + quoted(blocks.names[b]) + " vibrates by friction: its contacts changed their state in " +
        std::to_string(*worst) + " of the " + std::to_string(slid_[b]) +
        " substeps in which it slid: it does not slide as a rigid block does (damping = { stiffness = " +
        figure(damping_of_transit * transit_time(blocks.block(b))) +
        " }, or an implicit scheme and a 'time_step' longer than " + figure(transit_time(blocks.block(b))) +
        " s)");
  if (energy.created() > large_rise)
    texts.push_back("energy rose by " + figure(energy.created()) +
                    " of the largest exchanged above what loads and supports put in (a smaller 'time_step', "
                    "or scheme = \"decaying\"; scheme = \"newmark\" needs a gamma of 0.6)");
  return texts;
}

}  // namespace ddacontact
