// Where the tool of a mouse begins: a few mm off the bone, on a line into the picture through the planned cut, so that
// the wheel alone finds contact; a little beside it where the nearest bone would else be another tooth, so that the
// ring of the gap shows the site. Frames W and P, mm. Pure but for the gap it is given; start-up, 20 to 600 gaps.
#pragma once

#include <functional>
#include <optional>

#include "assets/ct_volume.h"
#include "assets/planned_cut.h"
#include "assets/prepared_tooth.h"
#include "assets/tooth_canals.h"
#include "render/frame.h"

namespace app {

/// Of the bur at the frame's pose.
using GapOf = std::function<std::optional<render::BoneGap>(const render::Frame&)>;

inline constexpr double kStartGap_mm = 5.0;

/// Position in W with that gap, in front of `goal_P` seen along z; none where no bone is near that line. `frame` gives
/// rig, bur and the rotation of the tool.
std::optional<glm::dvec3> startBeforeBone(const render::Frame& frame, const glm::dvec3& goal_P_mm, const GapOf& gap_of);
/// The same in front of the cut: the nearest bone is part of it, or as near to it as 8 mm to any side allow.
std::optional<glm::dvec3> startBeforePlan(const render::Frame& frame, const assets::PlannedCut& cut,
                                          const GapOf& gap_of);

/// Over the middle of a tooth's pulp chamber, kStartGap_mm above its highest cusp: in P.
glm::dvec3 startOverCrown_P_mm(const assets::ToothCanals& tooth);
/// Over the middle of a crown.
glm::dvec3 startOverCrown_P_mm(const assets::PreparedTooth& tooth, const assets::CtVolume& ct);

}  // namespace app
