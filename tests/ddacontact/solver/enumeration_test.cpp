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
    contact.law = {.normal_stiffness = 1, .tangential_stiffness = 0.4, .friction = uniform(0, 0.3)};
  }
};

/// Every solution of the equations of some states, which are open, sticking, sliding forward or backward, that
/// these states agree with.
/// \param[in] gives_way  contacts by their stiffnesses: N = -p g, T = -p_t s; else not at all
std::vector<VectorXd> all_solutions(const PointsOnSprings& step, const std::vector<Contact>& contacts,
                                    bool gives_way) {
  const auto n_d = static_cast<Index>(step.loads().size()), n_c = static_cast<Index>(contacts.size());
  std::vector<VectorXd> solutions;
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
      if (gives_way) K(N, N) = 1 / contact.law.normal_stiffness;
      b[N] = -gap.constant;
      if (state(c) == 1) {
        K.row(T).head(n_d) = of_slip;
        if (gives_way) K(T, T) = 1 / contact.law.tangential_stiffness;
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
    const VectorXd d = x.head(n_d);
    for (Index c = 0; c < n_c; ++c) {
      const Contact& contact = contacts[static_cast<std::size_t>(c)];
      const double N = x[n_d + 2 * c], T = x[n_d + 2 * c + 1];
      const VertexEdgeForm gap = contact.first_gap(), slip = contact.first_slip();
      const double g = gap.constant + contact.motion.change_along(gap.gradient, d),
                   s = slip.constant + contact.motion.change_along(slip.gradient, d);
      if (state(c) == 0) agrees = agrees && g >= -tolerance;
      if (state(c) > 0) agrees = agrees && N >= -tolerance;
      if (state(c) == 1) agrees = agrees && std::abs(T) <= contact.law.friction * N + tolerance;
      const double slid = gives_way ? s + T / contact.law.tangential_stiffness : s;
      if (state(c) == 2) agrees = agrees && slid >= -tolerance;
      if (state(c) == 3) agrees = agrees && slid <= tolerance;
    }
    if (agrees) solutions.push_back(d);
  }
  return solutions;
}

double nearest_to(const VectorXd& d, const std::vector<VectorXd>& solutions) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const VectorXd& solution : solutions)
    nearest = std::min(nearest, (solution - d).lpNorm<Eigen::Infinity>());
  return nearest;
}

/// Forces are those of the law at d, and balance the springs: more contacts than unknowns may share them in
/// several ways.
void expect_law_and_balance(const PointsOnSprings& step, const std::vector<Contact>& contacts,
                            const VectorXd& d, double accuracy, const std::string& name) {
  VectorXd left = step.loads();
  for (int b = 1; b < step.n_blocks(); ++b) left.segment<2>(2 * b) -= step.spring(b) * d.segment<2>(2 * b);
  for (const Contact& contact : contacts) {
    const VertexEdgeForm gap = contact.first_gap(), slip = contact.first_slip();
    const double g = gap.constant + contact.motion.change_along(gap.gradient, d),
                 s = slip.constant + contact.motion.change_along(slip.gradient, d), N = contact.normal,
                 T = contact.shear, bound = contact.law.friction * N;
    EXPECT_GE(N, -accuracy) << name;
    EXPECT_GE(g, -accuracy) << name;
    EXPECT_LE(std::min(N, g), accuracy) << name;
    EXPECT_LE(std::abs(T), bound + accuracy) << name;
    EXPECT_TRUE(std::abs(T) >= bound - accuracy || std::abs(s) <= accuracy) << name << ": it slips";
    EXPECT_LE(T * s, accuracy) << name << ": friction resists";
    contact.motion.form(gap.gradient).add_gradient(N, left);
    contact.motion.form(slip.gradient).add_gradient(T, left);
  }
  EXPECT_LE(left.tail(left.size() - 2).lpNorm<Eigen::Infinity>(), accuracy) << name;
}

class Enumeration : public testing::Test {
 protected:
  /// Calls check(step, contacts, name) for two hundred problems.
  template <class Check>
  void for_problems(const Check& check) {
    for (unsigned seed = 0; seed < 200; ++seed) {
      RandomProblem made(seed);
      PointsOnSprings step(made.springs, made.loads);
      check(step, made.contacts, "seed " + std::to_string(seed));
    }
  }
  void expect_solved(const ContactSolverOptions& options) {
    const double accuracy = 100 * options.penetration_tolerance;
    for_problems([&](PointsOnSprings& step, std::vector<Contact>& contacts, const std::string& name) {
      VectorXd d = VectorXd::Zero(step.loads().size());
      const ContactSolverReport report = solve_contacts(step, options, contacts, d);
      n_sweeps += report.sweeps;
      n_interior += report.interior_point_solves;
      n_fallbacks += report.sweep_fallbacks;
      // Contacts that nearly oppose each other converge slowly, and say so.
      n_penetrating += report.status == SolutionStatus::penetrating;
      if (report.status == SolutionStatus::penetrating) return;
      ASSERT_EQ(report.status, SolutionStatus::settled) << name;
      EXPECT_LE(nearest_to(d, all_solutions(step, contacts, false)), accuracy) << name;
      expect_law_and_balance(step, contacts, d, accuracy, name);
    });
    EXPECT_LE(n_penetrating, 6);
  }

  int n_penetrating = 0, n_sweeps = 0, n_interior = 0, n_fallbacks = 0;
};

}  // namespace

TEST_F(Enumeration, HasASolutionAndSeldomSeveral) {
  int n_several = 0;
  for_problems([&](PointsOnSprings& step, std::vector<Contact>& contacts, const std::string& name) {
    const std::vector<VectorXd> solutions = all_solutions(step, contacts, false);
    ASSERT_FALSE(solutions.empty()) << name;
    n_several += std::ranges::any_of(
        solutions, [&](const VectorXd& one) { return nearest_to(one, {solutions.front()}) > 1e-6; });
  });
  EXPECT_LE(n_several, 10);
}

TEST_F(Enumeration, HasWhatTheActiveSetFinds) {
  ContactSolverOptions options(1e-10, 1e-6);
  options.is_static = true;
  options.interior_point = false;
  expect_solved(options);
  EXPECT_EQ(n_interior, 0);
}

/// Where the contacts outnumber the unknowns sweeps are slow, and leave it to the active set.
TEST_F(Enumeration, HasWhatSweepsFind) {
  ContactSolverOptions options(1e-10, 1e-4);
  options.local = true;
  expect_solved(options);
  EXPECT_GT(n_sweeps, 200);
  EXPECT_LE(n_fallbacks, 50);
}

/// The interior-point method solves for contacts that give way, whose gaps the multipliers close afterwards.
/// What it leaves of mu and of balance is a thousandth of the forces.
TEST_F(Enumeration, HasWhatTheInteriorPointMethodFinds) {
  ContactSolverOptions options(1e-10, 1e-6);
  options.is_static = true;
  for_problems([&](PointsOnSprings& step, std::vector<Contact>& list, const std::string& name) {
    VectorXd d = VectorXd::Zero(step.loads().size());
    AugmentedContacts contacts(step, options, list);
    step.linearize(d);
    contacts.begin();
    contacts.evaluate(d);
    Residual residual;
    step.compute_residual(d, list, contacts.terms(), contacts.forces(), residual);
    std::vector<unsigned char> states;
    const InteriorReport report = find_interior_point_states(
        step, {contacts.contacts(), contacts.laws(), contacts.terms(), [&] { contacts.evaluate(d); }}, d,
        states);
    ASSERT_TRUE(report.found) << name;
    EXPECT_LE(nearest_to(d, all_solutions(step, list, true)), 1e-2) << name;
  });
}
