// All solvers of contact problems against all states that their contacts may have: a step of points on springs
// is small enough to try every one.
#include <ddacontact/solver/augmented_contacts.hpp>
#include <ddacontact/solver/interior_point.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace ddacontact;

namespace {

/// Blocks without rotation or deformation, of the two unknowns 2 b and 2 b + 1 each, on springs; block 0 is held.
class PointsOnSprings : public StepProblem {
 public:
  PointsOnSprings(std::vector<Mat2> springs, const VectorXd& loads)
      : springs_(std::move(springs)),
        loads_(loads),
        prescribed_(VectorXd::Zero(loads.size())),
        lengths_(VectorXd::Ones(loads.size())),
        problem_(rows(n_blocks()), static_cast<int>(loads.size()) - 2) {
    polyfem::Connectivity unknowns;
    for (int b = 1; b < n_blocks(); ++b) unknowns.append(std::vector<int>{2 * b, 2 * b + 1});
    problem_.set_matrices(unknowns);
    for (int b = 1; b < n_blocks(); ++b) problem_.elements()[b - 1] = springs_[b];
  }

  int n_blocks() const { return static_cast<int>(springs_.size()); }
  const Mat2& spring(int b) const { return springs_[b]; }
  const VectorXd& loads() const { return loads_; }

  bool is_explicit() const override { return false; }
  const VectorXd& prescribed() const override { return prescribed_; }
  const VectorXd& unknown_lengths() const override { return lengths_; }
  void compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                        const std::vector<ContactTerm>& terms, const std::vector<ContactForce>& forces,
                        Residual& residual) const override {
    residual = {};
    residual.external = loads_;
    std::vector<double>& sums = sums_;
    sums.assign(springs_.size(), 0);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      terms[c].gap.add_gradient(forces[c].normal, residual.external);
      terms[c].slip.add_gradient(forces[c].shear, residual.external);
      for (int b : contacts[c].pair.blocks()) sums[b] += std::hypot(forces[c].normal, forces[c].shear);
    }
    residual.force = -residual.external;
    for (int b = 1; b < n_blocks(); ++b) {
      const Vec2 spring = springs_[b] * d.segment<2>(2 * b);
      residual.force.segment<2>(2 * b) += spring;
      sums[b] += spring.norm() + loads_.segment<2>(2 * b).norm();
      const double left = residual.force.segment<2>(2 * b).lpNorm<1>();
      residual.largest = std::max(residual.largest, left);
      residual.scale = std::max(residual.scale, sums[b]);
      residual.round_off = std::max(residual.round_off, 1e-14 * sums[b]);
      if (left / sums[b] <= residual.block_relative) continue;
      residual.block_relative = left / sums[b];
      residual.worst_block = b;
    }
    sums[0] = std::numeric_limits<double>::infinity();
  }
  double sum_of_forces(int block) const override { return sums_[block]; }
  double contact_stiffness(const Contact& contact) const override {
    const Vec2 n = contact.motion.start.outwards();
    double lower = std::numeric_limits<double>::infinity();
    for (int b : contact.pair.blocks())
      if (b > 0) lower = std::min(lower, n.dot(springs_[b] * n));
    return lower;
  }
  VectorXd displacement(VectorXd& d) const override { return d; }
  void move(const VectorXd& change, VectorXd& d) const override { d += change; }
  std::optional<std::vector<double>> bends(const VectorXd&, const VectorXd&) const override {
    return std::vector<double>(springs_.size(), 0);
  }
  void linearize(const VectorXd&) override { problem_.matrices_changed(); }
  FrictionProblem& problem() override { return problem_; }

 private:
  static std::vector<int> rows(int n_blocks) {
    std::vector<int> rows{-1, -1};
    for (int u = 0; u < 2 * n_blocks - 2; ++u) rows.push_back(u);
    return rows;
  }

  std::vector<Mat2> springs_;
  VectorXd loads_, prescribed_, lengths_;
  mutable std::vector<double> sums_;
  FrictionProblem problem_;
};

/// Two to four blocks in a random chain from the held one on, two contacts at most more than that.
struct RandomProblem {
  std::mt19937 random;
  std::vector<Contact> contacts;
  std::vector<Mat2> springs{Mat2::Identity()};
  VectorXd loads;

  explicit RandomProblem(unsigned seed) : random(seed) {
    const int n_free = 1 + static_cast<int>(seed % 3);
    for (int b = 0; b < n_free; ++b) {
      const Mat2 a = Mat2::NullaryExpr([&] { return uniform(-1, 1); });
      springs.emplace_back(a * a.transpose() + Mat2::Identity());
    }
    loads = VectorXd::NullaryExpr(2 * n_free + 2, [&] { return uniform(-3, 3); });
    for (int b = 1; b <= n_free; ++b) add_contact(b, b - 1);
    for (int more = 0; more < 4 - n_free; ++more) add_contact(1 + more % n_free, 0);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }

  /// In the middle of an edge of 1 m in any direction, which it touches or is up to 1 m away from.
  void add_contact(int vertex_block, int edge_block) {
    Contact& contact = contacts.emplace_back();
    contact.pair = {vertex_block, static_cast<int>(contacts.size()), edge_block,
                    static_cast<int>(contacts.size())};
    const double angle = uniform(0, 6);
    const Vec2 along(std::cos(angle), std::sin(angle)), outwards(along.y(), -along.x());
    const bool touches = uniform(0, 1) < 0.5;
    contact.motion.start = {touches ? Vec2(Vec2::Zero()) : Vec2(uniform(0, 1) * outwards), -along / 2,
                            along / 2};
    contact.motion.i = PointMap(2 * vertex_block);
    if (edge_block > 0) contact.motion.j = contact.motion.k = PointMap(2 * edge_block);
    contact.history.lock = 0.5;
    if (touches) contact.history.state = contact.start_state = ContactState::stick;
    contact.meets = true;
    contact.straight_before = contact.straight_after = 100;  // an edge without ends
    contact.size = 1;
    contact.law = {.normal_stiffness = 1, .tangential_stiffness = 0.4, .friction = uniform(0, 0.4)};
  }
};

/// In one of four states each: open, sticking, sliding forward or backward.
struct Solution {
  VectorXd d;
  std::vector<ContactForce> forces;
};

/// Every solution of the equations of some states that these states agree with.
std::vector<Solution> all_solutions(const PointsOnSprings& step, const std::vector<Contact>& contacts) {
  const auto n_d = static_cast<Index>(step.loads().size()), n_c = static_cast<Index>(contacts.size());
  std::vector<Solution> solutions;
  for (int code = 0; code < std::pow(4, n_c); ++code) {
    MatrixXd K = MatrixXd::Zero(n_d + 2 * n_c, n_d + 2 * n_c);
    VectorXd b = VectorXd::Zero(n_d + 2 * n_c);
    K.topLeftCorner<2, 2>().setIdentity();
    for (int of = 1; of < step.n_blocks(); ++of) {
      K.block<2, 2>(2 * of, 2 * of) = step.spring(of);
      b.segment<2>(2 * of) = step.loads().segment<2>(2 * of);
    }
    const auto state = [&](Index c) { return code >> (2 * c) & 3; };
    for (Index c = 0; c < n_c; ++c) {
      const Contact& contact = contacts[static_cast<std::size_t>(c)];
      const VertexEdgeForm gap = contact.first_gap(), slip = contact.first_slip();
      const Index N = n_d + 2 * c, T = N + 1;
      VectorXd of_gap = VectorXd::Zero(n_d), of_slip = of_gap;
      contact.motion.form(gap.gradient).add_gradient(1, of_gap);
      contact.motion.form(slip.gradient).add_gradient(1, of_slip);
      K.block(2, N, n_d - 2, 1) = -of_gap.tail(n_d - 2);
      K.block(2, T, n_d - 2, 1) = -of_slip.tail(n_d - 2);
      if (state(c) == 0) {
        K(N, N) = K(T, T) = 1;
        continue;
      }
      K.row(N).head(n_d) = of_gap;
      b[N] = -gap.constant;
      if (state(c) == 1) {
        K.row(T).head(n_d) = of_slip;
        b[T] = -slip.constant;
      } else {
        K(T, T) = 1;
        K(T, N) = (state(c) == 2 ? 1 : -1) * contact.law.friction;
      }
    }
    const Eigen::FullPivLU<MatrixXd> lu(K);
    if (!lu.isInvertible()) continue;
    const VectorXd x = lu.solve(b);
    constexpr double tolerance = 1e-9;
    bool agrees = true;
    Solution solution{x.head(n_d), {}};
    for (Index c = 0; c < n_c; ++c) {
      const Contact& contact = contacts[static_cast<std::size_t>(c)];
      const double N = x[n_d + 2 * c], T = x[n_d + 2 * c + 1];
      const VertexEdgeForm gap = contact.first_gap(), slip = contact.first_slip();
      const double g = gap.constant + contact.motion.change_along(gap.gradient, solution.d),
                   s = slip.constant + contact.motion.change_along(slip.gradient, solution.d);
      solution.forces.push_back({N, T});
      if (state(c) == 0) agrees = agrees && g >= -tolerance;
      if (state(c) > 0) agrees = agrees && N >= -tolerance;
      if (state(c) == 1) agrees = agrees && std::abs(T) <= contact.law.friction * N + tolerance;
      if (state(c) == 2) agrees = agrees && s >= -tolerance;
      if (state(c) == 3) agrees = agrees && s <= tolerance;
    }
    if (agrees) solutions.push_back(std::move(solution));
  }
  return solutions;
}

double distance(const Solution& a, const VectorXd& d) {
  return (a.d - d).lpNorm<Eigen::Infinity>();
}

/// One of all solutions, where the forces are too.
void expect_one_of(const std::vector<Solution>& solutions, const VectorXd& d,
                   const std::vector<ContactForce>& forces, const std::string& name) {
  const auto nearest = std::ranges::min_element(
      solutions, {}, [&](const Solution& solution) { return distance(solution, d); });
  ASSERT_NE(nearest, solutions.end()) << name;
  EXPECT_LE(distance(*nearest, d), 1e-7) << name;
  for (std::size_t c = 0; c < forces.size(); ++c) {
    EXPECT_NEAR(forces[c].normal, nearest->forces[c].normal, 1e-6) << name << ", contact " << c;
    EXPECT_NEAR(forces[c].shear, nearest->forces[c].shear, 1e-6) << name << ", contact " << c;
  }
}

ContactSolverOptions tight() {
  ContactSolverOptions options(1e-10, 1e-9);
  options.is_static = true;
  return options;
}

class Enumeration : public testing::Test {
 protected:
  /// Calls check(step, contacts, all solutions, name) for two hundred problems.
  template <class Check>
  void for_problems(const Check& check) {
    for (unsigned seed = 0; seed < 200; ++seed) {
      RandomProblem made(seed);
      PointsOnSprings step(made.springs, made.loads);
      check(step, made.contacts, all_solutions(step, made.contacts), "seed " + std::to_string(seed));
    }
  }
  void expect_solved(const ContactSolverOptions& options) {
    for_problems([&](PointsOnSprings& step, std::vector<Contact>& contacts,
                     const std::vector<Solution>& solutions, const std::string& name) {
      VectorXd d = VectorXd::Zero(step.loads().size());
      const ContactSolverReport report = solve_contacts(step, options, contacts, d);
      ASSERT_EQ(report.status, SolutionStatus::settled) << name;
      n_sweeps += report.sweeps;
      n_interior += report.interior_point_solves;
      n_fallbacks += report.sweep_fallbacks;
      std::vector<ContactForce> forces;
      for (const Contact& contact : contacts) forces.push_back({contact.normal, contact.shear});
      expect_one_of(solutions, d, forces, name);
    });
  }

  int n_sweeps = 0, n_interior = 0, n_fallbacks = 0;
};

}  // namespace

TEST_F(Enumeration, OfStatesHasASolutionThatIsTheOnlyOneAsARule) {
  int n_several = 0;
  for_problems([&](PointsOnSprings&, std::vector<Contact>&, const std::vector<Solution>& solutions,
                   const std::string& name) {
    EXPECT_FALSE(solutions.empty()) << name;
    for (const Solution& solution : solutions) n_several += distance(solution, solutions.front().d) > 1e-6;
  });
  EXPECT_LE(n_several, 4);
}

TEST_F(Enumeration, HasWhatTheActiveSetFinds) {
  ContactSolverOptions options = tight();
  options.interior_point = false;
  expect_solved(options);
  EXPECT_EQ(n_interior, 0);
}

TEST_F(Enumeration, HasWhatSweepsFind) {
  ContactSolverOptions options = tight();
  options.is_static = false;
  options.local = true;
  expect_solved(options);
  EXPECT_GT(n_sweeps, 200);
  EXPECT_LE(n_fallbacks, 10);
}

/// From the states that it finds the active-set iteration has no state to change.
TEST_F(Enumeration, HasWhatTheInteriorPointMethodFinds) {
  const ContactSolverOptions options = tight();
  for_problems([&](PointsOnSprings& step, std::vector<Contact>& list, const std::vector<Solution>& solutions,
                   const std::string& name) {
    VectorXd d = VectorXd::Zero(step.loads().size());
    AugmentedContacts contacts(step, options, list);
    step.linearize(d);
    contacts.begin();
    contacts.evaluate(d);
    std::vector<unsigned char> states;
    const InteriorReport report = find_interior_point_states(
        step, {contacts.contacts(), contacts.laws(), contacts.terms(), [&] { contacts.evaluate(d); }}, d,
        states);
    ASSERT_TRUE(report.found) << name;
    const auto nearest = std::ranges::min_element(
        solutions, {}, [&](const Solution& solution) { return distance(solution, d); });
    ASSERT_NE(nearest, solutions.end());
    for (std::size_t c = 0; c < states.size(); ++c) {
      const auto [N, T] = nearest->forces[c];
      const double bound = list[c].law.friction * N;
      if (N > 1e-3) EXPECT_TRUE(states[c] & normal_acts) << name << ", contact " << c;
      if (N > 1e-3 && T > bound * (1 - 1e-6)) EXPECT_TRUE(states[c] & at_upper) << name << ", contact " << c;
      if (N > 1e-3 && T < -bound * (1 - 1e-6)) EXPECT_TRUE(states[c] & at_lower) << name << ", contact " << c;
      if (std::abs(T) < bound - 1e-3) EXPECT_TRUE(states[c] & shear_acts) << name << ", contact " << c;
    }
  });
}
