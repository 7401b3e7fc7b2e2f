/// \file GEOS behind its C interface: a context whose errors are exceptions, geometries that free themselves.
/// For sources of this folder alone; not installed.
#pragma once

#include <polyfem/core/error.hpp>
#include <polyfem/core/types.hpp>

#include <geos_c.h>

#include <memory>
#include <string>
#include <utility>

namespace polyfem {

/// A GEOS handle; a failed call is an Error with its message.
class GeosContext {
 public:
  /// `task` completes "GEOS could not ..." in messages.
  explicit GeosContext(std::string task) : handle_(GEOS_init_r()), task_(std::move(task)) {
    GEOSContext_setErrorMessageHandler_r(
        handle_, [](const char* message, void* text) { *static_cast<std::string*>(text) = message; },
        &message_);
  }
  GeosContext(const GeosContext&) = delete;
  GeosContext& operator=(const GeosContext&) = delete;
  ~GeosContext() { GEOS_finish_r(handle_); }

  GEOSContextHandle_t handle() const { return handle_; }
  template <class T>
  T* checked(T* result) const {
    if (!result) fail();
    return result;
  }
  [[noreturn]] void fail() const { throw Error("GEOS could not " + task_ + ": " + message_); }

 private:
  GEOSContextHandle_t handle_;
  std::string task_, message_;
};

/// Frees what GEOS made.
struct DestroyGeometry {
  GEOSContextHandle_t handle;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  void operator()(const GEOSPreparedGeometry* geometry) const {
    GEOSPreparedGeom_destroy_r(handle, geometry);
  }
};
/// A geometry that frees itself.
using GeosGeometry = std::unique_ptr<GEOSGeometry, DestroyGeometry>;

/// What a call made, or its Error.
inline GeosGeometry own(const GeosContext& geos, GEOSGeometry* geometry) {
  return {geos.checked(geometry), DestroyGeometry{geos.handle()}};
}

/// Of points; belongs to the geometry that is made of it.
inline GEOSCoordSequence* coordinates(const GeosContext& geos, const PointsRef& points) {
  return geos.checked(GEOSCoordSeq_copyFromBuffer_r(geos.handle(), points.data(),
                                                    static_cast<unsigned>(points.cols()), 0, 0));
}

/// The points of a line or ring.
inline Points points_of(const GeosContext& geos, const GEOSGeometry* line) {
  const GEOSCoordSequence* sequence = geos.checked(GEOSGeom_getCoordSeq_r(geos.handle(), line));
  unsigned size = 0;
  if (!GEOSCoordSeq_getSize_r(geos.handle(), sequence, &size)) geos.fail();
  Points points(2, size);
  if (!GEOSCoordSeq_copyToBuffer_r(geos.handle(), sequence, points.data(), 0, 0)) geos.fail();
  return points;
}

}  // namespace polyfem
