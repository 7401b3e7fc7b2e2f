#include <tests/support/contact_walls.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace support {

using ddacontact::CoulombLaw;

namespace {

constexpr double gravity = 9.8;  // m/s^2
constexpr double poisson = 0.3;
/// Contacts of up to this distance take part, in sizes of a block.
constexpr double search_margin = 0.01;

Quadrilateral box(double left, double bottom, double right, double top) {
  return {{Vec2(left, bottom), Vec2(right, bottom), Vec2(right, top), Vec2(left, top)}};
}

/// Consistent mass and plane-strain stiffness of a bilinear quadrilateral, 2 x 2 Gauss points.
std::pair<MatrixXd, MatrixXd> matrices(const Quadrilateral& block, double modulus) {
  const double lambda = modulus * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               shear = modulus / (2 * (1 + poisson)), point = 1 / std::sqrt(3.0);
  Eigen::Matrix3d D;
  D << lambda + 2 * shear, lambda, 0, lambda, lambda + 2 * shear, 0, 0, 0, shear;
  Eigen::Matrix<double, 4, 2> X;
  for (int i = 0; i < 4; ++i) X.row(i) = block.vertices[static_cast<std::size_t>(i)];
  MatrixXd M = MatrixXd::Zero(8, 8), K = MatrixXd::Zero(8, 8);
  for (const double a : {-point, point})
    for (const double b : {-point, point}) {
      const Eigen::Vector4d N =
          0.25 * Eigen::Vector4d((1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b), (1 - a) * (1 + b));
      Eigen::Matrix<double, 2, 4> dN;
      dN << -(1 - b), 1 - b, 1 + b, -(1 + b), -(1 - a), -(1 + a), 1 + a, 1 - a;
      const Eigen::Matrix2d J = 0.25 * dN * X;
      const Eigen::Matrix<double, 2, 4> g = J.inverse() * (0.25 * dN);
      MatrixXd B = MatrixXd::Zero(3, 8), S = MatrixXd::Zero(2, 8);
      for (int i = 0; i < 4; ++i) {
        B(0, 2 * i) = B(2, 2 * i + 1) = g(0, i);
        B(1, 2 * i + 1) = B(2, 2 * i) = g(1, i);
        S(0, 2 * i) = S(1, 2 * i + 1) = N[i];
      }
      K += J.determinant() * B.transpose() * D * B;
      M += J.determinant() * block.density * S.transpose() * S;
    }
  return {M, K};
}

}  // namespace

std::vector<Quadrilateral> wall(int side) {
  std::vector<Quadrilateral> blocks{box(-1, -1, side + 1, 0)};
  blocks.front().fixed = true;
  for (int row = 0; row < side; ++row) {
    const int odd = row % 2;
    for (int k = 0; k < side + odd; ++k)
      blocks.push_back(box(std::max(0.0, k - 0.5 * odd), 0.5 * row,
                           std::min(static_cast<double>(side), k + 1 - 0.5 * odd), 0.5 * (row + 1)));
  }
  return blocks;
}

std::vector<Quadrilateral> stack(int n) {
  std::vector<Quadrilateral> blocks{box(-2, -1, 3, 0)};
  blocks.front().fixed = true;
  for (int k = 0; k < n; ++k) blocks.push_back(box(0, k, 1, k + 1));
  return blocks;
}

std::vector<Quadrilateral> arch(int n, double inner_radius, double outer_radius) {
  std::vector<Quadrilateral> blocks{box(-outer_radius, -1, -inner_radius, 0),
                                    box(inner_radius, -1, outer_radius, 0)};
  for (Quadrilateral& springer : blocks) springer.fixed = true;
  for (int k = 0; k < n; ++k) {
    const double from = std::numbers::pi * k / n, to = std::numbers::pi * (k + 1) / n;
    const Vec2 a(std::cos(from), std::sin(from)), b(std::cos(to), std::sin(to));
    blocks.push_back(
        {{Vec2(inner_radius * a), Vec2(outer_radius * a), Vec2(outer_radius * b), Vec2(inner_radius * b)}});
  }
  return blocks;
}

QuadrilateralSystem::QuadrilateralSystem(std::vector<Quadrilateral> outlines, double modulus, double friction)
    : friction_(friction) {
  for (const Quadrilateral& outline : outlines) {
    Block block{outline,           Vec2::Zero(),         VectorXd::Ones(8),
                VectorXd::Zero(8), MatrixXd::Zero(8, 8), VectorXd::Zero(8),
                VectorXd::Zero(8)};
    const auto [M, K] = matrices(outline, modulus);
    const double mass = M(Eigen::seqN(0, 4, 2), Eigen::seqN(0, 4, 2)).sum();
    for (int i = 0; i < 4; ++i)
      block.centre += M.col(2 * i).sum() / mass * outline.vertices[static_cast<std::size_t>(i)];
    for (int i = 0; i < 4; ++i) {
      const Vec2 r = outline.vertices[static_cast<std::size_t>(i)] - block.centre;
      block.shape(2 * i, 0) = block.shape(2 * i + 1, 1) = 1;
      block.shape(2 * i, 2) = -r.y();
      block.shape(2 * i + 1, 2) = r.x();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(K, M);
    block.shape.rightCols(5) = modes.eigenvectors().rightCols(5);
    block.frequency2.tail(5) = modes.eigenvalues().tail(5);
    block.mass.head(2).setConstant(mass);
    block.mass[2] = block.shape.col(2).dot(M * block.shape.col(2));
    numbers_.push_back(static_cast<int>(blocks_.size()));
    blocks_.push_back(block);
  }
  std::erase_if(numbers_, [&](int b) { return blocks_[static_cast<std::size_t>(b)].outline.fixed; });
  const auto bounds = [&](int b) {
    Eigen::AlignedBox2d box;
    for (const Vec2& y : blocks_[static_cast<std::size_t>(b)].outline.vertices) box.extend(y);
    return box;
  };
  const int n = static_cast<int>(blocks_.size());
  std::vector<int> order(blocks_.size());
  for (int b = 0; b < n; ++b) order[static_cast<std::size_t>(b)] = b;
  std::vector<Eigen::AlignedBox2d> boxes;
  for (int b = 0; b < n; ++b) boxes.push_back(bounds(b));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return boxes[static_cast<std::size_t>(a)].min().x() < boxes[static_cast<std::size_t>(b)].min().x();
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Eigen::AlignedBox2d &a = boxes[static_cast<std::size_t>(order[i])],
                                &b = boxes[static_cast<std::size_t>(order[j])];
      if (b.min().x() > a.max().x() + search_margin) break;
      if (b.min().y() > a.max().y() + search_margin || a.min().y() > b.max().y() + search_margin) continue;
      find_contacts(order[i], order[j]);
      find_contacts(order[j], order[i]);
    }
}

/// Vertices of one block with edges of another: of each vertex the edge it is farthest outside of, and of
/// equal ones that most parallel to a side of its own.
void QuadrilateralSystem::find_contacts(int one, int other) {
  const Block &a = blocks_[static_cast<std::size_t>(one)], &b = blocks_[static_cast<std::size_t>(other)];
  if (a.outline.fixed && b.outline.fixed) return;
  const auto vertex = [](const Block& block, int i) {
    return block.outline.vertices[static_cast<std::size_t>((i + 4) % 4)];
  };
  for (int i = 0; i < 4; ++i) {
    const Vec2 y = vertex(a, i);
    const Vec2 sides[2] = {(vertex(a, i + 1) - y).normalized(), (vertex(a, i - 1) - y).normalized()};
    double best = -1e30, gap = 0, place = 0, length = 1;
    int edge = -1;
    for (int e = 0; e < 4; ++e) {
      const Vec2 from = vertex(b, e), along = vertex(b, e + 1) - from, t = along.normalized(),
                 n(t.y(), -t.x());
      const double down[2] = {sides[0].dot(n), sides[1].dot(n)};
      if (std::min(down[0], down[1]) < -0.1) continue;  // it does not point towards this edge
      const double g = (y - from).dot(n),
                   score = g - 1e-3 * std::min(std::abs(down[0]), std::abs(down[1])) - 1e-6 * e;
      if (score <= best) continue;
      best = score;
      edge = e;
      gap = g;
      place = (y - from).dot(t) / along.norm();
      length = along.norm();
    }
    if (edge < 0 || gap > search_margin || gap < -0.2 || place < -1e-6 || place > 1 + 1e-6) continue;
    const Vec2 t = (vertex(b, edge + 1) - vertex(b, edge)).normalized(), n(t.y(), -t.x());
    const auto node = [](const Block& block, int k) { return block.shape.middleRows(2 * (k % 4), 2); };
    const MatrixXd at_edge = (1 - place) * node(b, edge) + place * node(b, edge + 1),
                   turning = std::max(gap, 0.0) / length * (node(b, edge + 1) - node(b, edge));
    Contact contact;
    contact.one = one;
    contact.other = other;
    contact.gap = gap;
    contact.normal[0] = node(a, i).transpose() * n;
    contact.shear[0] = node(a, i).transpose() * t;
    contact.normal[1] = -at_edge.transpose() * n;
    contact.shear[1] = -at_edge.transpose() * t + turning.transpose() * n;
    contacts_.push_back(contact);
  }
}

ContactProblem QuadrilateralSystem::problem(double dt) const {
  ContactProblem problem;
  std::vector<int> number(blocks_.size(), -1);
  for (const int i : numbers_) {
    const Block& block = blocks_[static_cast<std::size_t>(i)];
    const VectorXd growth = (1 + dt * dt * block.frequency2.array()).matrix();  // backward Euler
    VectorXd free = block.velocity - dt * block.frequency2.cwiseProduct(block.displacement);
    free[1] -= dt * gravity;
    const VectorXd mass = block.mass.cwiseProduct(growth);
    number[static_cast<std::size_t>(i)] = problem.add_body(mass, free.cwiseQuotient(growth));
    problem.body_scale.back() = block.mass[0] * (dt * gravity + block.velocity.head(2).lpNorm<1>());
  }
  const VectorXd none;
  for (const Contact& contact : contacts_) {
    const int one = number[static_cast<std::size_t>(contact.one)],
              other = number[static_cast<std::size_t>(contact.other)];
    CoulombLaw law;
    law.friction = friction_;
    law.time = dt;
    const double tolerance = 1e-7;  // m: gaps below are closed
    problem.add_contact({one, one < 0 ? none : contact.normal[0], one < 0 ? none : contact.shear[0]},
                        {other, other < 0 ? none : contact.normal[1], other < 0 ? none : contact.shear[1]},
                        {contact.gap > tolerance ? contact.gap / dt : 0.0, 0.0}, law);
    problem.impulses.back() = contact.impulse;
  }
  return problem;
}

void QuadrilateralSystem::advance(const ContactProblem& solved, const VectorXd& z, double dt) {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const int contact = static_cast<int>(c);
    contacts_[c].impulse = solved.impulses[c];
    contacts_[c].gap += dt * (solved.rates(contact, z).normal - solved.offsets[c].normal);
  }
  for (std::size_t b = 0; b < numbers_.size(); ++b) {
    Block& block = blocks_[static_cast<std::size_t>(numbers_[b])];
    block.velocity = z.segment<8>(solved.first(static_cast<int>(b)));
    block.displacement += dt * block.velocity;
  }
}

}  // namespace support
