/// \file Several points side by side, one a lane: the compiler's vectors, as wide as the processor it
/// compiles for.
#pragma once

#include <polyfem/core/types.hpp>

#include <cstring>
#include <type_traits>

namespace polyfem {

/// Points handled at once: one register. GCC passes vectors of two registers through memory.
#ifdef __AVX512F__
inline constexpr Index n_lanes = 8;
#elif defined __AVX__
inline constexpr Index n_lanes = 4;
#else
inline constexpr Index n_lanes = 2;
#endif

/// A number for each of `n_lanes` points. Lanes do not meet: a point's result does not depend on the others.
using Lanes = double __attribute__((vector_size(n_lanes * sizeof(double))));

/// What holds for some of the lanes.
using LaneMask = decltype(Lanes{} < Lanes{});

/// A number that is the same for all points: in all lanes where spreading it takes an operation, else as it
/// is.
using Same = std::conditional_t<n_lanes == 2, Lanes, double>;

/// A vector of the plane for each of `n_lanes` points.
struct LaneVector {
  Lanes x, y;

  LaneVector& operator+=(const LaneVector& v) {
    x += v.x;
    y += v.y;
    return *this;
  }
  LaneVector& operator-=(const LaneVector& v) {
    x -= v.x;
    y -= v.y;
    return *this;
  }
};

/// The same number in all lanes.
inline Lanes in_all_lanes(double a) {
  return a - Lanes{};
}

/// The same vector in all lanes.
inline LaneVector in_all_lanes(const Vec2& v) {
  return {in_all_lanes(v.x()), in_all_lanes(v.y())};
}

/// The same number for all points.
inline Same same(double a) {
  return a - Same{};
}

/// Whether it holds for all lanes.
inline bool holds_for_all(const LaneMask& mask) {
  bool all = true;
  for (Index lane = 0; lane < n_lanes; ++lane) all = all && mask[lane];
  return all;
}

/// Writes the lanes to consecutive numbers.
inline void store(const Lanes& a, double* to) {
  std::memcpy(to, &a, sizeof a);
}

/// Lanes as an array of Eigen's, whose functions of them take one operation of the processor.
using LaneArray = Eigen::Array<double, n_lanes, 1>;
/// The same numbers.
inline LaneArray array_of(const Lanes& a) {
  LaneArray array;
  store(a, array.data());
  return array;
}
/// The same numbers.
inline Lanes lanes_of(const LaneArray& array) {
  Lanes result;
  std::memcpy(&result, array.data(), sizeof result);
  return result;
}

/// Square root, lane by lane.
inline Lanes sqrt(const Lanes& a) {
  return lanes_of(array_of(a).sqrt());
}

/// The size, lane by lane.
inline Lanes abs(const Lanes& a) {
  return lanes_of(array_of(a).abs());
}

/// The larger number, lane by lane.
inline Lanes larger(const Lanes& a, const Lanes& b) {
  return lanes_of(array_of(a).max(array_of(b)));
}

/// Sum, lane by lane.
inline LaneVector operator+(const LaneVector& a, const LaneVector& b) {
  return {a.x + b.x, a.y + b.y};
}

/// Difference, lane by lane.
inline LaneVector operator-(const LaneVector& a, const LaneVector& b) {
  return {a.x - b.x, a.y - b.y};
}

/// Product with a number, lane by lane.
inline LaneVector operator*(const Lanes& a, const LaneVector& v) {
  return {a * v.x, a * v.y};
}

/// z component of the cross product, lane by lane.
inline Lanes cross(const LaneVector& a, const LaneVector& b) {
  return a.x * b.y - a.y * b.x;
}

/// Dot product, lane by lane.
inline Lanes dot(const LaneVector& a, const LaneVector& b) {
  return a.x * b.x + a.y * b.y;
}

/// `a` in the lanes of a comparison that hold, `b` in the others.
template <class Comparison>
LaneVector select(const Comparison& holds, const LaneVector& a, const LaneVector& b) {
  return {holds ? a.x : b.x, holds ? a.y : b.y};
}

}  // namespace polyfem
