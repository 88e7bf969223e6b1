// Thermal model of an arm's motors: heat grows with the torque squared and decays with a time constant. 1 is the steady
// state of the continuous torque, the limit; 0 a cold motor. One thermal mass per motor. N mm, s. One thread; a few
// flops.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace haptics {

class MotorHeat {
 public:
  MotorHeat(const glm::dvec3& continuous_Nmm, double time_constant_s)
      : continuous_Nmm_(continuous_Nmm), time_constant_s_(time_constant_s) {}

  /// Exact for a torque held over `dt_s`.
  void add(const glm::dvec3& torque_Nmm, double dt_s) {
    const glm::dvec3 load = torque_Nmm / continuous_Nmm_, settled = load * load;
    heat_ += -std::expm1(-dt_s / time_constant_s_) * (settled - heat_);
  }

  double warmest() const { return std::max({heat_.x, heat_.y, heat_.z}); }

 private:
  glm::dvec3 continuous_Nmm_;
  double time_constant_s_;
  glm::dvec3 heat_{0.0};
};

}  // namespace haptics
