// How a scripted hand cleans a socket: suction held over one place after another, a curette drawn along the wall, a
// file drawn to and fro along edges, an instrument held at the place of a stitch. Frame P is the device's frame D;
// handle and tool coincide. mm, s. Pure; speeds and pressures are our defaults.
#pragma once

#include "app/procedure/third_molar/delivery_path.h"

namespace app {

/// From `from` through outside, place by place, and up again. `R_PT`: how the instrument is held where its shaft points
/// along `R_PT` z; at a place it is turned to that place's.
haptics::LedPath cleaningPath(const HandPose& from, const glm::dvec3& outside_P_mm, const CleaningStep& step,
                              double tip_radius_mm, const glm::dquat& R_PT);

}  // namespace app
