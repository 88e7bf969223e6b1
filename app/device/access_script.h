// How a scripted hand opens a tooth: a round bur along the tooth's axis, layer by layer over the outline of the chamber
// from the cusps through its roof, in lines to and fro. Frame P; mm, s. Start-up only. The hand plans from the chamber
// as it is known, and feels nothing.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "assets/tooth_canals.h"

namespace app {

/// Its bur: on the tray of a root-canal treatment.
inline constexpr const char* kAccessBur = "round:1.2";
inline constexpr double kAccessBurRadius_mm = 0.6;

/// Where the bur's middle goes, from above the crown and back there; turning all along.
std::vector<glm::dvec3> accessWay_P(const assets::ToothCanals& tooth);

}  // namespace app
