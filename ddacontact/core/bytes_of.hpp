/// \file How much of the heap arrays take.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// Bytes of a matrix' numbers.
template <class Derived>
double bytes_of(const Eigen::PlainObjectBase<Derived>& matrix) {
  return static_cast<double>(matrix.size()) * sizeof(typename Derived::Scalar);
}
/// Bytes of a vector's elements, with the room that it keeps, and of those that are arrays what they own.
template <class T>
double bytes_of(const std::vector<T>& elements) {
  double bytes = static_cast<double>(elements.capacity() * sizeof(T));
  if constexpr (requires { bytes_of(elements.front()); })
    for (const T& element : elements) bytes += bytes_of(element);
  return bytes;
}
/// Of several together.
template <class... Arrays>
requires(sizeof...(Arrays) > 1) double bytes_of(const Arrays&... arrays) {
  return (bytes_of(arrays) + ...);
}

}  // namespace ddacontact
