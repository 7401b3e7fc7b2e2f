/// \file VTK's names of number types.
#pragma once

#include <cstdint>

namespace polyfem {

template <class T>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<double> = "Float64";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";

}  // namespace polyfem
