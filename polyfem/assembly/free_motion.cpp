#include <polyfem/assembly/free_motion.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polyfem {
namespace {

constexpr double prescribed_tolerance =
    1e-14;  // of the squares of a motion at prescribed degrees of freedom, summed
constexpr double energy_tolerance = 1e-13;  // of the energy that the diagonal alone would give

/// The vertices of each part, parts one after another: vertex[first[p]] .. vertex[first[p + 1] - 1].
struct Parts {
  std::vector<int> first{0}, vertex;
};

Parts parts_of(const PolygonMesh& mesh, int n_components, const TiedUnknowns& tied) {
  const int n_vertices = static_cast<int>(mesh.vertices.cols());
  std::vector<int> parent(n_vertices);  // towards the part's lowest vertex
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](int v, int w) {
    const auto [low, high] = std::minmax({root_of(v), root_of(w)});
    parent[high] = low;
  };
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c)) join(v, mesh.cell(c)[0]);
  for (const auto& [unknown, tie] : tied.ties())
    for (const TieTerm& term : tie.terms) join(unknown / n_components, term.unknown / n_components);
  std::vector<int> part_of(n_vertices);
  Parts parts;
  for (int v = 0; v < n_vertices; ++v) {
    const int root = root_of(v);
    if (root == v) {
      part_of[v] = static_cast<int>(parts.first.size()) - 1;
      parts.first.push_back(0);
    } else
      part_of[v] = part_of[root];
    ++parts.first[part_of[v] + 1];
  }
  std::partial_sum(parts.first.begin(), parts.first.end(), parts.first.begin());
  std::vector<int> next(parts.first.begin(), parts.first.end() - 1);
  parts.vertex.resize(n_vertices);
  for (int v = 0; v < n_vertices; ++v) parts.vertex[next[part_of[v]]++] = v;
  return parts;
}

/// The motions of a part as columns: constants, then the rotation about its middle, each at most 1.
class Motions {
 public:
  Motions(const PolygonMesh& mesh, int n_components, std::span<const int> part)
      : mesh_(mesh), n_components_(n_components), part_(part) {
    Points vertices = mesh.vertices(Eigen::all, std::vector<int>(part.begin(), part.end()));
    middle_ = vertices.rowwise().mean();
    radius_ = (vertices.colwise() - middle_).colwise().norm().maxCoeff();
  }
  int n_motions() const { return n_components_ == 2 && radius_ > 0 ? 3 : n_components_; }
  /// The displacement of a vertex' component in each motion.
  VectorXd at(int vertex, int component) const {
    VectorXd row = VectorXd::Unit(n_motions(), component);
    const Vec2 arm = (mesh_.vertices.col(vertex) - middle_) / radius_;
    if (n_motions() > n_components_) row[2] = component == 0 ? -arm.y() : arm.x();
    return row;
  }

 private:
  const PolygonMesh& mesh_;
  int n_components_;
  std::span<const int> part_;
  Vec2 middle_;
  double radius_;
};

/// Those combinations of motions that leave prescribed degrees of freedom where they are and keep ties, one a
/// column.
MatrixXd not_prescribed(const Motions& motions, int n_components, std::span<const int> part,
                        const PrescribedDofs& prescribed, const TiedUnknowns& tied) {
  MatrixXd squares = MatrixXd::Zero(motions.n_motions(), motions.n_motions());
  for (const int v : part)
    for (int c = 0; c < n_components; ++c) {
      const int k = n_components * v + c;
      if (!prescribed.is_prescribed(k) && !tied.is_tied(k)) continue;
      VectorXd kept = motions.at(v, c);
      if (tied.is_tied(k))
        for (const auto& [other, factor] : tied.ties().at(k).terms)
          kept -= factor * motions.at(other / n_components, other % n_components);
      squares += kept * kept.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(squares);
  const Index n_free = (modes.eigenvalues().array() < prescribed_tolerance).count();
  return modes.eigenvectors().leftCols(n_free);
}

/// The combination of the given motions, a column an unknown, that costs no energy, if there is one. Reads
/// the columns of the part only.
std::optional<VectorXd> without_energy(const Eigen::Ref<const MatrixXd>& motions, int n_components,
                                       std::span<const int> part, const SparseMatrix& lower) {
  const Index n = motions.rows();
  MatrixXd energies = MatrixXd::Zero(n, n), scales = energies;
  VectorXd forces(n);
  for (const int v : part)
    for (int k = n_components * v; k < n_components * (v + 1); ++k) {
      forces.setZero();  // K times the motions, the upper triangle's part counted with the lower one's
      for (SparseMatrix::InnerIterator entry(lower, k); entry; ++entry)
        forces += (entry.row() == k ? 1 : 2) * entry.value() * motions.col(entry.row());
      energies += motions.col(k) * forces.transpose();
      scales += std::abs(lower.coeff(k, k)) * motions.col(k) * motions.col(k).transpose();
    }
  energies = (energies + energies.transpose()).eval() / 2;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(energies - energy_tolerance * scales);
  for (const auto combination : modes.eigenvectors().colwise())
    if (std::abs(combination.dot(energies * combination)) <=
        energy_tolerance * combination.dot(scales * combination))
      return combination;
  return std::nullopt;
}

}  // namespace

std::optional<FreeMotion> find_free_motion(const PolygonMesh& mesh, int n_components,
                                           const SparseMatrix& lower, const PrescribedDofs& prescribed,
                                           const TiedUnknowns& tied) {
  const Parts parts = parts_of(mesh, n_components, tied);
  MatrixXd rows(std::max(n_components, 3), lower.cols());  // as many of them as there are motions
  for (std::size_t p = 0; p + 1 < parts.first.size(); ++p) {
    const auto part = std::span(parts.vertex).subspan(parts.first[p], parts.first[p + 1] - parts.first[p]);
    const Motions motions(mesh, n_components, part);
    const MatrixXd free = not_prescribed(motions, n_components, part, prescribed, tied);
    if (free.cols() == 0) continue;
    auto displacements = rows.topRows(free.cols());
    for (const int v : part)
      for (int c = 0; c < n_components; ++c) {
        const int k = n_components * v + c;
        displacements.col(k).setZero();
        if (!prescribed.is_prescribed(k)) displacements.col(k) = free.transpose() * motions.at(v, c);
      }
    if (const auto combination = without_energy(displacements, n_components, part, lower)) {
      VectorXd motion = free * *combination;
      motion /= motion.lpNorm<Eigen::Infinity>();
      motion = (motion.array().abs() < 1e-9).select(0, motion);
      return FreeMotion{part[0], static_cast<int>(part.size()), motion.head(n_components),
                        motion.size() > n_components ? motion[n_components] : 0};
    }
  }
  return std::nullopt;
}

}  // namespace polyfem
