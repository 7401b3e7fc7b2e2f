#include <ddacontact/output/bolt_view.hpp>
#include <ddacontact/output/result_directory.hpp>

namespace ddacontact {

void ResultDirectory::write_bolt_history(const Stepper& stepper) {
  for (const Bolt& bolt : stepper.blocks().bolts) {
    const BoltView view(bolt, stepper.blocks(), stepper.state());
    const int most = view.most_loaded();
    if (most < 0) continue;
    int torn = 0;
    for (int k = 0; k < bolt.n_segments(); ++k) torn += bolt.has_segment(k) && view.is_torn(k);
    bolts_->row(stepper.counts().steps, stepper.state().time, bolt.name, most, view.axial(most),
                view.elongation(most), view.state(most), torn);
  }
}

void ResultDirectory::write_bolts(const Stepper& stepper) {
  CsvFile csv(file("bolts.csv"), "bolt,segment,block_a,block_b,axial_force,elongation,state,xa,ya,xb,yb");
  const BlockSystem& blocks = stepper.blocks();
  const Points positions = blocks.positions(stepper.state());
  for (const Bolt& bolt : blocks.bolts) {
    const BoltView view(bolt, blocks, stepper.state());
    for (int k = 0; k < bolt.n_segments(); ++k) {
      if (!bolt.has_segment(k)) continue;
      const MaterialPoint &a = bolt.nodes[k], &b = bolt.nodes[k + 1];
      const Vec2 from = blocks.interpolate(a, positions) + labels_.origin,
                 to = blocks.interpolate(b, positions) + labels_.origin;
      csv.row(bolt.name, k, labels_.block_names[a.block], labels_.block_names[b.block], view.axial(k),
              view.elongation(k), view.state(k), from.x(), from.y(), to.x(), to.y());
    }
  }
  csv.close();
}

}  // namespace ddacontact
