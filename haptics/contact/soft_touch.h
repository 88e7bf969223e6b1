// Contact of the instrument (head, shaft, handpiece) with soft tissue in one tick: part of a Tick, for the warnings,
// counts and marks. Frame P; mm, N, N mm. Trivially copyable; any thread. The default is no contact.
#pragma once

#include <cstdint>

#include <glm/gtc/quaternion.hpp>

#include "assets/soft_tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct SoftTouch {
  assets::SoftTissue tissue = assets::SoftTissue::none;    ///< pressed most
  assets::SoftTissue bur_cuts = assets::SoftTissue::none;  ///< in which a turning bur is: an error
  std::uint8_t tissues = 0;                                ///< all that are touched, assets::bitOf
  double depth_mm = 0.0;                                   ///< the hand is this far inside
  calibration::Point<calibration::Patient> place_P;        ///< on the tissue pressed most
  calibration::Vector<calibration::Patient> force_P_N;     ///< on the hand, before the safety layer
  calibration::Vector<calibration::Patient> torque_P_Nmm;  ///< the same, about T's origin
  glm::dquat turn_P{1.0, 0.0, 0.0, 0.0};                   ///< the tool as held: turn times the hand's attitude

  bool touches() const { return tissues != 0; }
};

}  // namespace haptics
