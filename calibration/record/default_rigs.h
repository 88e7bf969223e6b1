// The rigs that come with the program, before anything is measured. Frame W, mm. Plain values; any thread.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "calibration/rig.h"

namespace calibration {

/// "mirrored": a 45 degree mirror over the hand, panel above it · "desktop": a monitor without mirror.
inline constexpr std::array<std::string_view, 2> kDefaultRigs = {"mirrored", "desktop"};

/// None for another name.
std::optional<Rig> defaultRig(std::string_view name);

}  // namespace calibration
