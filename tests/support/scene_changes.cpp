#include "scene_changes.hpp"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>

namespace support {

using namespace ddacontact;

namespace {

/// Changes of a time function: of its values, and of its times.
template <class Change>
void change(TimeFunction& function, double time, const Change& value) {
  function.value = value(function.value);
  for (Vec3& entry : function.history) {
    const Vec2 changed = value(entry.tail<2>());
    entry = {entry[0] * time, changed[0], changed[1]};
  }
}

/// The analysis of the scene and those of its stages.
template <class Change>
void for_each_analysis(Scene& scene, const Change& change) {
  change(scene.analysis);
  for (StageDescription& stage : scene.stages) change(stage.analysis);
}

template <class Change>
void for_each_joint(Scene& scene, const Change& change) {
  for (Joint& joint : scene.joints) change(joint);
  for (StageDescription& stage : scene.stages)
    for (Joint& joint : stage.joints) change(joint);
}

bool is_signed_permutation(const Mat2& A) {
  return A.cwiseAbs().isApprox(Mat2::Identity()) ||
         A.cwiseAbs().isApprox(Mat2(Mat2::Identity().rowwise().reverse()));
}

}  // namespace

Scene moved(Scene scene, const Vec2& by) {
  for (BlockDescription& block : scene.blocks) block.vertices.colwise() += by;
  for (Load& load : scene.loads) load.at += by;
  for (Monitor& monitor : scene.monitors) monitor.at += by;
  return scene;
}

Scene on_grid(Scene scene, double spacing) {
  const auto rounded = [&](const auto& x) {
    return ((x.array() / spacing).round() * spacing).matrix().eval();
  };
  for (BlockDescription& block : scene.blocks) block.vertices = rounded(block.vertices);
  for (Load& load : scene.loads) load.at = rounded(load.at);
  for (Monitor& monitor : scene.monitors) monitor.at = rounded(monitor.at);
  return scene;
}

Scene scaled(Scene scene, const Units& by) {
  const double L = by.length, M = by.mass, T = by.time;
  const double velocity = L / T, stress = M / T / T, force = stress * L;
  for_each_analysis(scene, [&](AnalysisOptions& analysis) {
    analysis.time_step *= T;
    analysis.gravity *= velocity / T;
    analysis.damping.mass /= T;
    analysis.damping.stiffness *= T;
    analysis.mesh.cell_size *= L;
  });
  for_each_joint(scene, [&](Joint& joint) {
    joint.cohesion *= stress;
    joint.tensile_strength *= stress;
  });
  scene.contact.normal_stiffness *= stress;
  scene.contact.tangential_stiffness *= stress;
  for (Material& material : scene.materials) {
    material.density *= M / L / L;
    material.young *= stress;
  }
  for (BlockDescription& block : scene.blocks) {
    block.vertices *= L;
    block.mesh.cell_size *= L;
    block.velocity *= velocity;
    block.angular_velocity /= T;
    block.stress *= stress;
  }
  for (Support& support : scene.supports) {
    const double by_length = support.displacement.kind == TimeFunction::Kind::rate ? velocity : L;
    change(support.displacement, T, [&](const Vec2& value) -> Vec2 { return by_length * value; });
  }
  for (Load& load : scene.loads) {
    const double by_force = load.kind == Load::Kind::body       ? force / L / L
                            : load.kind == Load::Kind::pressure ? stress
                                                                : force;
    load.at *= L;
    change(load.force, T, [&](const Vec2& value) -> Vec2 { return by_force * value; });
  }
  for (Monitor& monitor : scene.monitors) monitor.at *= L;
  return scene;
}

Scene turned(Scene scene, const Mat2& by) {
  const double sense = by.determinant();
  const auto turn = [&](const Vec2& value) -> Vec2 { return by * value; };
  for_each_analysis(scene, [&](AnalysisOptions& analysis) { analysis.gravity = turn(analysis.gravity); });
  for (BlockDescription& block : scene.blocks) {
    block.vertices = (by * block.vertices).eval();
    block.velocity = turn(block.velocity);
    block.angular_velocity *= sense;
    Mat2 stress;
    stress << block.stress[0], block.stress[2], block.stress[2], block.stress[1];
    stress = by * stress * by.transpose();
    block.stress = {stress(0, 0), stress(1, 1), stress(0, 1)};
  }
  for (Support& support : scene.supports) {
    change(support.displacement, 1, turn);
    if (support.fix_x == support.fix_y) continue;
    if (!is_signed_permutation(by)) throw Error("a support along one axis cannot be turned by any angle");
    if (std::abs(by(0, 0)) < 0.5) std::swap(support.fix_x, support.fix_y);
  }
  for (Load& load : scene.loads) {
    load.at = turn(load.at);
    if (load.kind != Load::Kind::pressure) change(load.force, 1, turn);
  }
  for (Monitor& monitor : scene.monitors) monitor.at = turn(monitor.at);
  return scene;
}

Scene shaken(Scene scene, unsigned seed) {
  std::mt19937 random(seed);
  for (BlockDescription& block : scene.blocks)
    for (double& x : block.vertices.reshaped())
      x *= 1 + (static_cast<int>(random() % 3) - 1) * std::numeric_limits<double>::epsilon();
  return scene;
}

Scene renumbered(Scene scene, int shift, bool other_way) {
  std::vector<int> counts;
  for (const BlockDescription& block : scene.blocks)
    counts.push_back(static_cast<int>(block.vertices.cols()));
  const auto number = [&](int block, int k) {
    const int n = counts[static_cast<std::size_t>(block)], moved_on = (k + shift) % n;
    return other_way ? n - 1 - moved_on : moved_on;
  };
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    BlockDescription& block = scene.blocks[b];
    const Points before = block.vertices;
    for (int k = 0; k < counts[b]; ++k) block.vertices.col(number(static_cast<int>(b), k)) = before.col(k);
    for (int& k : block.fixed_vertices) k = number(static_cast<int>(b), k);
  }
  for (Support& support : scene.supports)
    for (int& k : support.vertices) k = number(support.block, k);
  for (Load& load : scene.loads) {
    if (load.kind != Load::Kind::pressure) continue;
    const int n = counts[static_cast<std::size_t>(load.block)];
    // The edge starts at the other of its two vertices where numbers run the other way.
    load.edge = number(load.block, other_way ? (load.edge + 1) % n : load.edge);
  }
  for (Monitor& monitor : scene.monitors)
    if (monitor.kind == Monitor::Kind::vertex) monitor.vertex = number(monitor.block, monitor.vertex);
  return scene;
}

Scene reordered(Scene scene, const std::vector<int>& order) {
  const std::vector<BlockDescription> before = scene.blocks;
  const auto number = [&](int& block) { block = order[static_cast<std::size_t>(block)]; };
  for (std::size_t b = 0; b < before.size(); ++b)
    scene.blocks[static_cast<std::size_t>(order[b])] = before[b];
  for (Support& support : scene.supports) number(support.block);
  for (Load& load : scene.loads) number(load.block);
  for (Monitor& monitor : scene.monitors) number(monitor.block);
  for (StageDescription& stage : scene.stages)
    for (std::vector<int>* blocks : {&stage.removed, &stage.added})
      for (int& block : *blocks) number(block);
  return scene;
}

std::vector<Points> vertex_displacements(const BuiltScene& built) {
  const BlockSystem& blocks = built.stepper->blocks();
  const Points all = blocks.displacements(built.stepper->state());
  std::vector<Points> by_block;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const OutlineLabels& labels = *built.labels.outlines[static_cast<std::size_t>(b)];
    Points& of = by_block.emplace_back(2, labels.n_vertices);
    const int first = blocks.block(b).vertices().first;
    for (std::size_t v = 0; v < labels.vertex.size(); ++v)
      if (labels.vertex[v] < labels.n_vertices)
        of.col(labels.vertex[v]) = all.col(first + static_cast<Index>(v));
  }
  return by_block;
}

}  // namespace support
