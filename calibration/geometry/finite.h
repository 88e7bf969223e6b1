// Whether all components are finite. Any thread.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace calibration {

inline bool isFinite(const glm::dvec3& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace calibration
