/// \file How much of the heap arrays take.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// Bytes of a vector's elements, with the room that it keeps; not what these own in turn.
template <class T>
double bytes_of(const std::vector<T>& elements) {
  return static_cast<double>(elements.capacity() * sizeof(T));
}
/// Bytes of a matrix' numbers.
template <class Derived>
double bytes_of(const Eigen::PlainObjectBase<Derived>& matrix) {
  return static_cast<double>(matrix.size()) * sizeof(typename Derived::Scalar);
}

}  // namespace ddacontact
