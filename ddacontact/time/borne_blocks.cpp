#include <ddacontact/time/borne_blocks.hpp>

namespace ddacontact {

void start_borne_blocks(const BlockSystem& blocks, const std::vector<Contact>& contacts,
                        const StepStart& start, VectorXd& d) {
  std::vector<char> is_borne(blocks.n_blocks(), 0);
  for (const Contact& contact : contacts)
    if (contact.history.normal > 0)
      is_borne[contact.pair.vertex_block] = is_borne[contact.pair.edge_block] = 1;
  const double slow = blocks.gravity.norm() * start.dt;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    if (!is_borne[b] || !blocks.is_free(b)) continue;
    bool is_slow = true;
    for (int v = 0; v < block.n_vertices(); ++v)
      is_slow = is_slow && block.vertex_map(v)(start.velocity).norm() <= slow;
    if (is_slow) d.segment(u.first, u.count) = start.dt * start.velocity.segment(u.first, u.count);
  }
}

}  // namespace ddacontact
