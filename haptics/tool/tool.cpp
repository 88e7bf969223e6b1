#include "haptics/tool/tool.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

constexpr double kShankRadius_mm = 2.35 / 2.0, kNeckPart = 0.6, kOutOfHandpiece_mm = 25.0;
constexpr double kBetweenBeaks_mm = 2.0;  // radius: a tooth is gripped when it reaches so near
constexpr double kThickestShaft_mm = 5.0, kLongestShaft_mm = 100.0;

}  // namespace

Tool sanitised(const Tool& tool) noexcept {
  Tool safe{sanitised(tool.head), {}, tool.handpiece, tool.grips};
  const Shaft& shaft = tool.shaft;
  if (shaft.radius_mm > 0.0 && shaft.length_mm > 0.0 && std::isfinite(shaft.radius_mm) &&
      std::isfinite(shaft.length_mm))
    safe.shaft = {std::min(shaft.radius_mm, kThickestShaft_mm), std::min(shaft.length_mm, kLongestShaft_mm)};
  return safe;
}

Tool forcepsTool() noexcept { return {{ShapeKind::sphere, kBetweenBeaks_mm, 0.0}, {}, false, true}; }

Shaft standardShaft(const BurShape& head) noexcept {
  return {std::min(kShankRadius_mm, kNeckPart * head.radius_mm), kOutOfHandpiece_mm};
}

}  // namespace haptics
