#include <ddacontact/output/result_directory.hpp>

#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/run_verdict.hpp>
#include <polyfem/io/write_error.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <numbers>

namespace ddacontact {

namespace {

constexpr char monitors_file[] = "monitors.csv", monitors_header[] = "step,time,monitor,x,y,ux,uy,vx,vy";
constexpr char energy_file[] = "energy.csv",
               energy_header[] =
                   "step,time,kinetic,elastic,gravity,friction_dissipated,numerical_dissipated,external,"
                   "balance_error,damping_dissipated,pushed_out,plastic_dissipated,unbalanced,fastest";
constexpr char bolts_file[] = "bolt_history.csv",
               bolts_header[] = "step,time,bolt,segment,axial_force,elongation,state,torn";
constexpr char supports_file[] = "support_history.csv", supports_header[] = "step,time,block,fx,fy";

const char* state_name(ContactState state) {
  switch (state) {
    case ContactState::open:
      return "open";
    case ContactState::stick:
      return "stick";
    case ContactState::slip_forward:
    case ContactState::slip_backward:
      return "slip";
  }
  return "";
}

using NameOfBlock = std::function<std::string(int)>;

nlohmann::ordered_json stages_of(const Stepper& stepper, const NameOfBlock& name_of) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::array();
  const auto add_stage = [&](const StageEnd& end) {
    stages.push_back({{"name", stepper.stages()[end.stage].name},
                      {"steps", end.steps},
                      {"time", end.time},
                      {"came_to_rest", end.came_to_rest},
                      {"at_rest", end.at_rest},
                      {"unbalanced", end.equilibrium.unbalanced},
                      {"unbalanced_block", name_of(end.equilibrium.unbalanced_block)},
                      {"fastest", end.equilibrium.fastest},
                      {"fastest_block", name_of(end.equilibrium.fastest_block)}});
  };
  for (const StageEnd& end : stepper.stage_ends()) add_stage(end);
  add_stage(stepper.stage_end());
  return stages;
}

/// Null where the scheme has none.
nlohmann::ordered_json stable_step_of(const Stepper& stepper, const NameOfBlock& name_of) {
  const std::optional<StableStep>& step = stepper.stable_step();
  if (!step) return nullptr;
  return {{"critical_step", step->critical},
          {"block", name_of(step->block)},
          {"longest_substep", step->dt},
          {"decaying_blocks", step->n_decaying}};
}

/// Null where no domain was cut.
nlohmann::ordered_json cut_of(const RunSummary& summary) {
  const auto& cut = summary.domain;
  if (!cut) return nullptr;
  return {{"blocks", cut->blocks},
          {"slivers_merged", cut->slivers_merged},
          {"slivers_left", cut->slivers_left},
          {"dangling_removed", cut->dangling_removed},
          {"connecting_joints", cut->connecting_joints},
          {"t_vertices", cut->t_vertices},
          {"area", cut->area}};
}

nlohmann::ordered_json energy_of(const Stepper& stepper) {
  const Energy& e = stepper.energy().now;
  return {{"kinetic", e.kinetic},
          {"elastic", e.elastic},
          {"gravity", e.gravity},
          {"friction_dissipated", e.friction_dissipated},
          {"numerical_dissipated", e.numerical_dissipated},
          {"external", e.external},
          {"balance_error", stepper.energy().balance_error()},
          {"damping_dissipated", e.damping_dissipated},
          {"pushed_out", e.pushed_out},
          {"plastic_dissipated", e.plastic_dissipated}};
}

nlohmann::ordered_json seconds_of(const StepTimes& times, const RunSummary& summary) {
  return {{"total", summary.seconds_total},  {"setup", summary.seconds_setup},
          {"steps", summary.seconds_steps},  {"detection", times.detection},
          {"assembly", times.assembly},      {"solver", times.solver},
          {"analysis", times.analysis},      {"factorization", times.factorization},
          {"solution", times.solution},      {"update", times.update},
          {"output", summary.seconds_output}};
}

}  // namespace

std::filesystem::path make_directory(std::filesystem::path directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw OutputError("cannot make directory \"" + directory.string() + "\": " + error.message());
  return directory;
}

namespace {

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::remove(path, error); error)
    throw OutputError("cannot remove \"" + path.string() + "\": " + error.message());
}

/// Makes the directory without what an earlier run wrote at its end, or was writing when it was killed.
std::filesystem::path begin_directory(std::filesystem::path directory) {
  directory = make_directory(std::move(directory));
  for (const char* name :
       {"summary.json", "blocks.csv", "vertices.csv", "contacts.csv", "bolts.csv", "supports.csv"})
    remove_file(directory / name);
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (entry.path().extension().string().starts_with(".part")) remove_file(entry.path());
  return directory;
}

}  // namespace

ResultDirectory::ResultDirectory(std::filesystem::path directory, Labels labels, const FrameOptions& frames)
    : directory_(begin_directory(std::move(directory))),
      labels_(std::move(labels)),
      energy_(file(energy_file), energy_header),
      monitors_(file(monitors_file), monitors_header),
      frames_(directory_, frames) {
  for (const char* name : {bolts_file, supports_file}) remove_file(directory_ / name);
  if (labels_.has_bolts) bolts_.emplace(file(bolts_file), bolts_header);
  if (!labels_.supported_blocks.empty()) supports_.emplace(file(supports_file), supports_header);
}

ResultDirectory::ResultDirectory(std::filesystem::path directory, Labels labels, const FrameOptions& frames,
                                 const std::filesystem::path& source, const ResultMarks& marks)
    : directory_(begin_directory(std::move(directory))),
      labels_(std::move(labels)),
      energy_(file(energy_file), energy_header, source / energy_file, marks.energy),
      monitors_(file(monitors_file), monitors_header, source / monitors_file, marks.monitors),
      frames_(directory_, frames, source, marks.n_frames) {
  if (labels_.has_bolts) bolts_.emplace(file(bolts_file), bolts_header, source / bolts_file, marks.bolts);
  if (!labels_.supported_blocks.empty())
    supports_.emplace(file(supports_file), supports_header, source / supports_file, marks.supports);
}

std::vector<std::string> ResultDirectory::missing_histories() const {
  std::vector<std::string> missing;
  if (!monitors_.goes_on()) missing.push_back(monitors_file);
  if (!energy_.goes_on()) missing.push_back(energy_file);
  if (bolts_ && !bolts_->goes_on()) missing.push_back(bolts_file);
  if (supports_ && !supports_->goes_on()) missing.push_back(supports_file);
  if (!frames_.goes_on()) missing.push_back("frames");
  return missing;
}

ResultMarks ResultDirectory::marks() {
  return {monitors_.mark(), energy_.mark(), bolts_ ? bolts_->mark() : FileMark{},
          supports_ ? supports_->mark() : FileMark{}, frames_.n_frames()};
}

void ResultDirectory::write_start(const Stepper& stepper, const std::vector<MonitorTarget>& monitor_targets) {
  if (!monitors_.goes_on()) write_monitors(stepper, monitor_targets);
  if (!energy_.goes_on()) write_energy(stepper);
  if (bolts_ && !bolts_->goes_on()) write_bolt_history(stepper);
  if (supports_ && !supports_->goes_on()) write_support_history(stepper);
  if (!frames_.goes_on()) frames_.write_step(stepper, labels_);
  marks();  // what there is of the histories is in their files
}

void ResultDirectory::write_step(const Stepper& stepper, const std::vector<MonitorTarget>& monitor_targets) {
  write_monitors(stepper, monitor_targets);
  write_energy(stepper);
  if (bolts_) write_bolt_history(stepper);
  if (supports_) write_support_history(stepper);
  frames_.write_step(stepper, labels_);
}

void ResultDirectory::write_monitors(const Stepper& stepper,
                                     const std::vector<MonitorTarget>& monitor_targets) {
  for (const MonitorTarget& target : monitor_targets) {
    if (!stepper.blocks().is_present(target.block())) continue;
    const Motion motion = observe(target, stepper);
    const Vec2 x = motion.position + labels_.origin;
    monitors_.row(stepper.counts().steps, stepper.state().time, target.name, x.x(), x.y(),
                  motion.displacement.x(), motion.displacement.y(), motion.velocity.x(), motion.velocity.y());
  }
}

void ResultDirectory::write_energy(const Stepper& stepper) {
  const Energy& e = stepper.energy().now;
  energy_.row(stepper.counts().steps, stepper.state().time, e.kinetic, e.elastic, e.gravity,
              e.friction_dissipated, e.numerical_dissipated, e.external, stepper.energy().balance_error(),
              e.damping_dissipated, e.pushed_out, e.plastic_dissipated, stepper.equilibrium().unbalanced,
              stepper.equilibrium().fastest);
}

void ResultDirectory::finish(const Stepper& stepper, const RunSummary& summary) {
  monitors_.close();
  energy_.close();
  if (bolts_) bolts_->close();
  if (supports_) supports_->close();
  write_blocks(stepper);
  write_vertices(stepper);
  write_contacts(stepper);
  if (bolts_) write_bolts(stepper);
  write_supports(stepper);
  write_summary(stepper, summary);
}

void ResultDirectory::write_blocks(const Stepper& stepper) {
  CsvFile csv(
      file("blocks.csv"),
      "block,model,vertices,x,y,area,area_ratio,rotation_deg,vx,vy,sxx_mean,sxx_min,sxx_max,syy_mean,syy_min,"
      "syy_max,sxy_mean,sxy_min,sxy_max,s1_max,s2_min,omega,cells,unknowns,reason");
  const BlockState& state = stepper.state();
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) {
    if (!stepper.blocks().is_present(b)) continue;
    const Block& block = stepper.blocks().block(b);
    const Vec2 x = block.centroid(state) + labels_.origin;
    const double area = block.moments(state).area;
    const RigidVelocity velocity = rigid_velocity(block, state, state.velocity);
    const StressRange s = stress_range(block, state);
    csv.row(labels_.block_names[b], labels_.block_models[b], labels_.outlines[b]->n_vertices, x.x(), x.y(),
            area, area / block.reference_area(), state.rotation[b] * 180 / std::numbers::pi,
            velocity.linear.x(), velocity.linear.y(), s.mean[0], s.min[0], s.max[0], s.mean[1], s.min[1],
            s.max[1], s.mean[2], s.min[2], s.max[2], s.s1_max, s.s2_min, velocity.angular, block.n_cells(),
            block.n_unknowns(), labels_.block_reasons[b]);
  }
  csv.close();
}

void ResultDirectory::write_vertices(const Stepper& stepper) {
  CsvFile csv(file("vertices.csv"), "block,vertex,x,y,ux,uy,vx,vy");
  const BlockState& state = stepper.state();
  const Points positions = stepper.blocks().positions(state),
               displacements = stepper.blocks().displacements(state);
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) {
    if (!stepper.blocks().is_present(b)) continue;
    const Block& block = stepper.blocks().block(b);
    const std::vector<int> order = labels_.outlines[b]->in_scene_order();
    for (int scene_v = 0; scene_v < block.n_vertices(); ++scene_v) {
      const int v = order[scene_v];
      const int column = block.vertices().first + v;
      const Vec2 x = positions.col(column) + labels_.origin;
      const Vec2 u = displacements.col(column);
      const Vec2 velocity = block.vertex_map(v)(state.velocity);
      csv.row(labels_.block_names[b], scene_v, x.x(), x.y(), u.x(), u.y(), velocity.x(), velocity.y());
    }
  }
  csv.close();
}

void ResultDirectory::write_contacts(const Stepper& stepper) {
  CsvFile csv(file("contacts.csv"), "block_a,vertex,block_b,edge,state,gap,normal_force,shear_force,joint");
  for (const ContactRecord& contact : stepper.contacts()) {
    if (!contact.was_closed) continue;
    const VertexEdge& pair = contact.pair;
    const OutlineLabels &a = *labels_.outlines[pair.vertex_block], &b = *labels_.outlines[pair.edge_block];
    // An edge of a block given clockwise runs the other way in the scene's order.
    const double shear = b.turned ? -contact.shear : contact.shear;
    csv.row(labels_.block_names[pair.vertex_block], a.vertex[pair.vertex],
            labels_.block_names[pair.edge_block], b.edge[pair.edge], state_name(contact.history.state),
            contact.end_gap, contact.normal, shear,
            labels_.joint_names[stepper.contact_properties().joint_of(pair)]);
  }
  csv.close();
}

void ResultDirectory::write_summary(const Stepper& stepper, const RunSummary& summary) {
  const StepCounts& counts = stepper.counts();
  const Equilibrium& rest = stepper.equilibrium();
  const FurthestMove furthest = furthest_move(stepper);
  const NameOfBlock name_of = [&](int block) {
    return block < 0 ? std::string() : labels_.block_names[block];
  };
  const nlohmann::ordered_json json = {{"status", summary.status},
                                       {"reason", summary.reason},
                                       {"steps_completed", counts.steps},
                                       {"substeps", counts.substeps},
                                       {"rejected_steps", counts.rejected},
                                       {"unconverged_steps", counts.unconverged},
                                       {"time", stepper.state().time},
                                       {"blocks", stepper.blocks().n_present()},
                                       {"dofs", stepper.blocks().n_equations()},
                                       {"contacts_max", counts.contacts_max},
                                       {"contacts_end", counts.contacts},
                                       {"open_close_iterations", counts.contact_iterations},
                                       {"linear_solves", counts.linear_solves},
                                       {"factorizations", counts.factorizations},
                                       {"max_penetration", counts.max_penetration},
                                       {"interior_paths", counts.interior_point_solves},
                                       {"augmentations", counts.augmentations},
                                       {"sweeps", counts.sweeps},
                                       {"newton_iterations", counts.contact_iterations},
                                       {"interior_point_solves", counts.interior_solutions},
                                       {"tolerance_largest", counts.largest_tolerance},
                                       {"scheme", summary.scheme},
                                       {"explicit", stable_step_of(stepper, name_of)},
                                       {"solver_fallbacks", counts.solver_fallbacks},
                                       {"broken_bonds", counts.broken_bonds},
                                       {"impacts", counts.impacts},
                                       {"limited_impacts", counts.limited_impacts},
                                       {"unsettled_impacts", counts.unsettled_impacts},
                                       {"max_residual", counts.max_residual},
                                       {"overlap_rejections", counts.overlap_rejections},
                                       {"corner_solutions", counts.corner_solutions},
                                       {"unsettled_corners", counts.unsettled_corners},
                                       {"unknown_velocities", counts.unknown_velocities},
                                       {"unbalanced", rest.unbalanced},
                                       {"unbalanced_block", name_of(rest.unbalanced_block)},
                                       {"blocks_unbalanced", rest.n_unbalanced},
                                       {"at_rest", stepper.is_at_rest()},
                                       {"fastest", rest.fastest},
                                       {"fastest_block", name_of(rest.fastest_block)},
                                       {"furthest", furthest.of_size},
                                       {"furthest_block", name_of(furthest.block)},
                                       {"stages", stages_of(stepper, name_of)},
                                       {"warnings", summary.warnings},
                                       {"analyses", stepper.times().analyses},
                                       {"resumed_after", summary.resumed_after},
                                       {"energy", energy_of(stepper)},
                                       {"wall_seconds", seconds_of(stepper.times(), summary)},
                                       {"domain", cut_of(summary)},
                                       {"peak_memory_mb", summary.peak_memory_mb},
                                       {"versions", summary.versions}};
  const std::string path = file("summary.json");
  std::ofstream out(path, std::ios::binary);
  out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  out.close();
  if (!out) throw polyfem::write_error(path);
}

}  // namespace ddacontact
