// Where the tool of a mouse begins: on the line into the picture through the planned cut, a few mm off the bone, so
// that the wheel alone finds contact. Frames W and P, mm. Pure but for the gap it is given; start-up, about 200 gaps.
#pragma once

#include <functional>
#include <optional>

#include "render/frame.h"

namespace app {

/// Of the bur at the frame's pose.
using GapOf = std::function<std::optional<render::BoneGap>(const render::Frame&)>;

inline constexpr double kStartGap_mm = 5.0;

/// Position in W with that gap, in front of `goal_P` seen along z; none where no bone is near that line. `frame` gives
/// rig, bur and the rotation of the tool.
std::optional<glm::dvec3> startBeforeBone(const render::Frame& frame, const glm::dvec3& goal_P_mm, const GapOf& gap_of);

}  // namespace app
