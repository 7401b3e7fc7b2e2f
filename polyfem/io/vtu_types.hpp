/// \file VTK's names of number types.
#pragma once

#include <cstdint>

namespace polyfem {

/// What VTK calls a type; nullptr for others.
template <class T>
inline constexpr const char* vtk_type = nullptr;
/// \copydoc vtk_type
template <>
inline constexpr const char* vtk_type<double> = "Float64";
/// \copydoc vtk_type
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
/// \copydoc vtk_type
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
/// \copydoc vtk_type
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";

}  // namespace polyfem
