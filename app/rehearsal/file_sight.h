// How a root-canal file in the hand is seen: the tooth around it as clear as glass, its tip magnified in a corner while
// it is in the tooth or near it. Frame P, mm. Pure; once a frame, some µs.
#pragma once

#include <optional>

#include "assets/tooth_canals.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

/// From a tip to the nearest orifice; 0 in a canal.
double fromOrifice_mm(const assets::ToothCanals& tooth, const glm::dvec3& tip_P_mm);

/// The frame with its view mode and Frame::magnified by its layers; `mode`: of any other tool.
void showFileSight(const assets::ToothCanals& tooth, const haptics::Tick& tick, const haptics::Tool& tool,
                   render::ViewMode mode, render::Frame& frame);

}  // namespace app
