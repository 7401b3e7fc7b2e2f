#include <tests/support/elastic_solutions.hpp>

#include <cmath>
#include <numbers>

using namespace polyfem;

namespace support {
namespace {

double shear_modulus(double young, double poisson) {
  return young / (2 * (1 + poisson));
}

}  // namespace

Vec2 traction(const Vec3& stress, const Vec2& n) {
  return {stress[0] * n.x() + stress[2] * n.y(), stress[2] * n.x() + stress[1] * n.y()};
}

ElasticSolution manufactured_solution(double young, double poisson) {
  constexpr double pi = std::numbers::pi;
  const double mu = shear_modulus(young, poisson), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  const auto displacement = [](const Vec2& p) {
    return Vec2(std::sin(pi * p.x()) * std::sin(pi * p.y()), p.y() * p.y() * std::cos(pi * p.x()));
  };
  const auto stress = [D = elasticity_matrix(young, poisson, Plane::strain)](const Vec2& p) {
    const double s = std::sin(pi * p.x()), c = std::cos(pi * p.x()), y = p.y();
    return Vec3(D * Vec3(pi * c * std::sin(pi * y), 2 * y * c, pi * s * (std::cos(pi * y) - y * y)));
  };
  const auto body_force = [lambda, mu](const Vec2& p) {
    const double s = std::sin(pi * p.x()), c = std::cos(pi * p.x()), y = p.y();
    const Vec2 grad_div(-pi * s * (pi * std::sin(pi * y) + 2 * y), c * (pi * pi * std::cos(pi * y) + 2));
    const Vec2 laplacian(-2 * pi * pi * s * std::sin(pi * y), c * (2 - pi * pi * y * y));
    return Vec2(-(lambda + mu) * grad_div - mu * laplacian);
  };
  return {young, poisson, Plane::strain, displacement, stress, body_force};
}

ElasticSolution cantilever_solution(double young, double poisson, double length, double height,
                                    double force) {
  const double E = young / (1 - poisson * poisson), nu = poisson / (1 - poisson);  // of plane strain
  const double inertia = height * height * height / 12, square = height * height / 4;
  const auto displacement = [=](const Vec2& p) {
    const double x = p.x(), y = p.y();
    return Vec2(Vec2(-y * ((6 * length - 3 * x) * x + (2 + nu) * (y * y - square)),
                     3 * nu * y * y * (length - x) + (4 + 5 * nu) * square * x + (3 * length - x) * x * x) *
                (force / (6 * E * inertia)));
  };
  const auto stress = [=](const Vec2& p) {
    return Vec3(Vec3(-(length - p.x()) * p.y(), 0, (square - p.y() * p.y()) / 2) * (force / inertia));
  };
  return {young, poisson, Plane::strain, displacement, stress, {}};
}

ElasticSolution hole_solution(double young, double poisson, double radius, double tension) {
  const double mu = shear_modulus(young, poisson), kappa = 3 - 4 * poisson;
  const auto displacement = [=](const Vec2& p) {
    const double q = radius / p.norm(), angle = std::atan2(p.y(), p.x());
    const double c = std::cos(angle), s = std::sin(angle), c3 = std::cos(3 * angle), s3 = std::sin(3 * angle);
    return Vec2(Vec2((kappa + 1) * c / q + 2 * q * ((1 + kappa) * c + c3) - 2 * q * q * q * c3,
                     (kappa - 3) * s / q + 2 * q * ((1 - kappa) * s + s3) - 2 * q * q * q * s3) *
                (tension * radius / (8 * mu)));
  };
  const auto stress = [=](const Vec2& p) {
    const double q2 = radius * radius / p.squaredNorm(), q4 = q2 * q2, angle = std::atan2(p.y(), p.x());
    const double c2 = std::cos(2 * angle), s2 = std::sin(2 * angle);
    const double c4 = std::cos(4 * angle), s4 = std::sin(4 * angle);
    return Vec3(Vec3(1 - q2 * (1.5 * c2 + c4) + 1.5 * q4 * c4, -q2 * (0.5 * c2 - c4) - 1.5 * q4 * c4,
                     -q2 * (0.5 * s2 + s4) + 1.5 * q4 * s4) *
                tension);
  };
  return {young, poisson, Plane::strain, displacement, stress, {}};
}

}  // namespace support
