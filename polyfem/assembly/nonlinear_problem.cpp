#include <polyfem/assembly/nonlinear_problem.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace polyfem {
namespace {

constexpr int most_iterations = 25;
constexpr int most_halvings = 8;
/// Of the largest displacement: what u may be off its ties.
constexpr double rounding = 1e-14;
/// Errors of a tangent from which on it is no derivative; kinks, as at yield, have less.
constexpr double wrong_tangent = 0.05;
/// What slopes ahead and behind may differ by, over the tangent, where there is no kink.
constexpr double smooth = 0.01;

/// What the next step must be below: the largest of the last three residuals, as of slender parts each second
/// one may rise (non-monotone line search, Grippo, Lampariello and Lucidi 1986). The first step is free: it
/// brings load and prescribed degrees of freedom on, and the residual before it is that of the load's
/// increment alone.
double residual_bound(const std::vector<double>& residuals) {
  if (residuals.size() < 2) return std::numeric_limits<double>::infinity();
  const auto first = residuals.end() - std::min<std::ptrdiff_t>(3, std::ssize(residuals) - 1);
  return *std::max_element(first, residuals.end());
}

/// Whether entries are left out for which the differences ahead and behind are not the same: those at kinks.
enum class Kinks { seen, left_out };

/// The largest difference of a cell's tangent from central differences of its forces at values `at`, over
/// the tangent's largest entry. Forces are evaluated there last: what materials store meanwhile is that of
/// `at`.
double difference_to_derivative(const NonlinearProblem::CellForces& cell_forces, int cell,
                                const Points& polygon, const VectorXd& at, double step, Kinks kinks) {
  MatrixXd K, unused;
  const auto forces_at = [&](const VectorXd& values, MatrixXd& tangent) {
    VectorXd forces = VectorXd::Zero(values.size());
    cell_forces(cell, polygon, values, tangent, forces);
    return forces;
  };
  const VectorXd here = forces_at(at, K);
  double largest = 0;
  for (Index k = 0; k < at.size(); ++k) {
    const VectorXd shift = step * VectorXd::Unit(at.size(), k);
    const VectorXd ahead = forces_at(at + shift, unused), behind = forces_at(at - shift, unused);
    const VectorXd slope = (ahead - behind) / (2 * step);
    const double kink = (ahead - 2 * here + behind).lpNorm<Eigen::Infinity>() / step;
    if (kinks == Kinks::left_out && kink > smooth * K.lpNorm<Eigen::Infinity>()) continue;
    largest = std::max(largest, (slope - K.col(k)).lpNorm<Eigen::Infinity>());
  }
  forces_at(at, unused);
  return largest / K.lpNorm<Eigen::Infinity>();
}

std::string wrong_tangent_of(int cell, double error) {
  return "the tangent of cell " + std::to_string(cell) + " differs by " + std::to_string(error) +
         " of its size from the derivative of its forces: correct it";
}

}  // namespace

NonlinearProblem::NonlinearProblem(const PolygonMesh& mesh, int n_components, CellForces cell_forces,
                                   Symmetry symmetry)
    : mesh_(&mesh),
      n_components_(n_components),
      cell_forces_(std::move(cell_forces)),
      linear_(mesh, n_components, symmetry),
      loads_(VectorXd::Zero(linear_.n_unknowns())),
      prescribed_values_(loads_),
      u_(loads_) {}

void NonlinearProblem::hold(int vertex, int component, double value) {
  linear_.hold(vertex, component, value);
  prescribed_values_[linear_.unknown(vertex, component)] = value;
}

void NonlinearProblem::tie(int vertex, int component, const std::vector<Followed>& followed,
                           double constant) {
  linear_.tie(vertex, component, followed, constant);
  remember_tie(vertex, component);
}

void NonlinearProblem::roll(int vertex, const Vec2& normal, double value) {
  remember_tie(vertex, linear_.roll(vertex, normal, value));
}

void NonlinearProblem::remember_tie(int vertex, int component) {
  const int k = linear_.unknown(vertex, component);
  const TiedUnknowns::Tie& tie = linear_.tied().ties().at(k);
  tied_.tie(k, tie.terms, tie.constant);
}

bool NonlinearProblem::prescribe(const VectorXd& u, double t) {
  bool moves = false;
  for (int k = 0; k < linear_.n_unknowns(); ++k) {
    if (!linear_.is_prescribed(k)) continue;
    const double way = t * prescribed_values_[k] - u[k];
    moves = moves || way != 0;
    linear_.hold(k / n_components_, k % n_components_, way);
  }
  for (const auto& [k, tie] : tied_.ties()) {
    double way = t * tie.constant - u[k];
    std::vector<Followed> followed;
    for (const auto& [other, factor] : tie.terms) {
      way += factor * u[other];
      followed.push_back({other / n_components_, other % n_components_, factor});
    }
    moves = moves || std::abs(way) > rounding * u.lpNorm<Eigen::Infinity>();
    linear_.tie(k / n_components_, k % n_components_, followed, way);
  }
  return moves;
}

void NonlinearProblem::add_load(int vertex, int component, double value) {
  linear_.clear_loads();
  linear_.add_load(vertex, component, value);
  loads_ += linear_.loads();
}

/// Tangent at u, and the forces out of balance as loads of the linear problem.
NonlinearProblem::Residual NonlinearProblem::assemble(const VectorXd& u, double t) {
  double largest_force = (t * loads_).lpNorm<Eigen::Infinity>();
  linear_.clear_loads();
  linear_.assemble([&](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    cell_forces_(cell, polygon, of_cell(cell, u), K, f);
    largest_force = std::max(largest_force, f.lpNorm<Eigen::Infinity>());
    f = -f;
  });
  linear_.add_loads(t * loads_);
  VectorXd residual = linear_.loads();
  linear_.pass_on(residual);
  Residual worst{0, 0};
  for (int k = 0; k < linear_.n_unknowns(); ++k)
    if (std::abs(residual[k]) > worst.relative) worst = {std::abs(residual[k]), k};
  if (largest_force > 0) worst.relative /= largest_force;
  return worst;
}

VectorXd NonlinearProblem::of_cell(int cell, const VectorXd& u) const {
  const std::span<const int> corners = mesh_->cell(cell);
  VectorXd values(n_components_ * static_cast<Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k)
    values.segment(n_components_ * static_cast<Index>(k), n_components_) =
        u.segment(n_components_ * corners[k], n_components_);
  return values;
}

double NonlinearProblem::tangent_error(int cell, const VectorXd& u) const {
  if (cell < 0 || cell >= mesh_->n_cells())
    throw Error("there is no cell " + std::to_string(cell) + ": cells are numbered 0 to " +
                std::to_string(mesh_->n_cells() - 1));
  const Points polygon = mesh_->outline(cell);
  const double step = 1e-6 * (polygon.rowwise().maxCoeff() - polygon.rowwise().minCoeff()).norm();
  return difference_to_derivative(cell_forces_, cell, polygon, of_cell(cell, u), step, Kinks::seen);
}

/// Where Newton's method stands, and whether the tangent there is to blame.
std::string NonlinearProblem::failure(const Residual& residual, const VectorXd& u) const {
  const int vertex = residual.worst_unknown / n_components_;
  std::string reason = "Newton's method has not converged in " + std::to_string(most_iterations) +
                       " iterations: the largest residual, " + std::to_string(residual.relative) +
                       " of the largest force, is at " + mesh_->vertex_name(vertex) + "; ";
  const int cell = VertexCells(*mesh_)[vertex].front();
  if (const double error = tangent_error(cell, u); error > wrong_tangent)
    return reason + wrong_tangent_of(cell, error);
  return reason + "take smaller load steps";
}

const VectorXd& NonlinearProblem::solve_linear() {
  try {
    return linear_.solve();
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + "; or take smaller load steps");
  }
}

void NonlinearProblem::require_derivative(int vertex, const VectorXd& u) const {
  const int cell = VertexCells(*mesh_)[vertex].front();
  const VectorXd at = of_cell(cell, u);
  const Points polygon = mesh_->outline(cell);
  // Before the cell has moved, all of it that yields is at a kink: the step is a part of its way, if that is
  // no round-off.
  const double way = (at - of_cell(cell, u_)).lpNorm<Eigen::Infinity>();
  const double size = (polygon.rowwise().maxCoeff() - polygon.rowwise().minCoeff()).norm();
  if (way < 1e-7 * std::max(size, at.lpNorm<Eigen::Infinity>())) return;
  const double error = difference_to_derivative(cell_forces_, cell, polygon, at, 1e-4 * way, Kinks::left_out);
  if (error > wrong_tangent) throw Error(wrong_tangent_of(cell, error));
}

NewtonReport NonlinearProblem::solve(double t, double tolerance) {
  NewtonReport report;
  VectorXd u = u_;
  try {
    // Prescribed degrees of freedom move in the first step; what is out of balance before says nothing about
    // the end.
    Residual residual = assemble(u, t);
    report.residuals.push_back(residual.relative);
    bool moves = prescribe(u, t);
    for (int iteration = 0; moves || residual.relative > tolerance; ++iteration) {
      if (iteration == most_iterations) {
        report.reason = failure(residual, u);
        return report;
      }
      const VectorXd step = solve_linear(), start = u;
      const double bound = moves ? std::numeric_limits<double>::infinity() : residual_bound(report.residuals);
      double length = 1;
      for (int halvings = 0;; ++halvings, length /= 2) {
        u = start + length * step;
        std::optional<Residual> there;
        try {
          there = assemble(u, t);
        } catch (const Error& error) {  // a cell turned inside out, say
          if (halvings == most_halvings) throw Error(std::string(error.what()) + "; take smaller load steps");
        }
        if (there && (there->relative < bound || halvings == most_halvings)) {
          residual = *there;
          break;
        }
      }
      report.residuals.push_back(residual.relative);
#ifndef NDEBUG
      require_derivative(residual.worst_unknown / n_components_, u);
#endif
      moves = prescribe(u, t) && length < 1;
    }
    u_ = u;
    report.converged = true;
  } catch (const Error& error) {
    report.reason = error.what();
  }
  return report;
}

}  // namespace polyfem
