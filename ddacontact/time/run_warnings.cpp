#include <ddacontact/time/run_warnings.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstdio>

namespace ddacontact {

namespace {

/// Of a block's size: within this much of sliding or turning contacts are taken at one place of the step.
constexpr double far = 0.1;

}  // namespace

void RunWarnings::look(const SeenStep& step) {
  const int n_blocks = step.blocks.n_blocks();
  std::vector<char> touches(n_blocks, 0), slides(n_blocks, 0), changes(n_blocks, 0);
  for (const Contact& contact : step.contacts) {
    const ContactState before = contact.start_state, after = contact.history.state;
    if (before == ContactState::open && after == ContactState::open) continue;
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block}) {
      touches[b] = 1;
      if (is_slipping(before) || is_slipping(after)) slides[b] = 1;
      if (before != after) changes[b] = 1;
    }
  }
  const auto see = [&](Doubt doubt, double value, int block) {
    Sighting& sighting = sightings_[static_cast<int>(doubt)];
    if (sighting.substeps++ == 0) sighting.first_time = step.time;
    if (value <= sighting.largest) return;
    sighting.largest = value;
    sighting.block = block;
  };
  double furthest = 0;
  int furthest_block = -1, n_touch = 0, n_change = 0;
  for (int b = 0; b < n_blocks; ++b) {
    if (!step.blocks.is_movable(b) || !touches[b]) continue;
    const int whole = step.in_whole.empty() ? b : step.in_whole[b];
    ++n_touch;
    if (changes[b]) ++n_change;
    if (slides[b] && !step.first) {
      ++slid_[whole];
      if (changes[b]) ++changed_[whole];
    }
    const Block& block = step.blocks.block(b);
    double moved = 0;
    for (int v = 0; v < block.n_vertices(); ++v)
      moved = std::max(moved, block.vertex_map(v)(step.d).norm());
    if (moved > furthest * block.size()) {
      furthest = moved / block.size();
      furthest_block = whole;
    }
  }
  if (furthest > far) see(Doubt::far_in_one_step, furthest, furthest_block);
  if (!step.first && 2 * n_change > n_touch)
    see(Doubt::contacts_changed, n_touch > 0 ? static_cast<double>(n_change) / n_touch : 0, -1);
}

std::vector<std::string> RunWarnings::texts(const std::vector<std::string>& names, long substeps,
                                            const EnergyLedger& energy) const {
  std::vector<std::string> texts;
  char line[400];
  for (const Sighting& s : sightings_) {
    std::snprintf(line, sizeof line, "PROBE %ld of %ld first %g largest %g block %d", s.substeps, substeps, s.first_time, s.largest, s.block);
    texts.push_back(line);
  }
  double worst = 0; long n=0, m=0;
  for (std::size_t b = 0; b < slid_.size(); ++b) if (slid_[b] > 20 && changed_[b] > worst * slid_[b]) { worst = double(changed_[b]) / slid_[b]; n = changed_[b]; m = slid_[b]; }
  std::snprintf(line, sizeof line, "PROBE vib %g = %ld of %ld; energy rise %g", worst, n, m, energy.risen());
  texts.push_back(line);
  return texts;
}

}  // namespace ddacontact
