#include "haptics/tool/tool.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

constexpr double kShankRadius_mm = 2.35 / 2.0, kNeckPart = 0.6, kOutOfHandpiece_mm = 25.0;
constexpr double kBetweenBeaks_mm = 2.0;                         // radius: a tooth is gripped when it reaches so near
constexpr double kBladeHalf_mm = 0.5, kBladeAndShank_mm = 40.0;  // thickness of a blade, its length with the shank
constexpr double kMostSealer_mm3 = 20.0;
constexpr double kThickestShaft_mm = 5.0, kLongestShaft_mm = 100.0;

constexpr double kFileHandleRadius_mm = 1.8;

double within(double value, double low, double high) {
  return std::isfinite(value) ? std::clamp(value, low, high) : 0.0;
}

CanalFile sanitised(const CanalFile& file) noexcept {
  if (const auto cone = file.cone())
    return {.size = file.size,
            .length_mm = file.length_mm,
            .cone_taper = cone->taper,
            .sealer_mm3 = within(file.sealer_mm3, 0.0, kMostSealer_mm3)};
  if (!file.made()) return {};
  CanalFile safe = file;
  safe.bent_deg = within(file.bent_deg, -90.0, 90.0);
  safe.bent_mm = within(file.bent_mm, 0.0, 10.0);
  safe.bent_towards_deg = within(file.bent_towards_deg, -360.0, 360.0);
  safe.stop_mm = within(file.stop_mm, 0.0, file.length_mm);
  safe.sealer_mm3 = 0.0;
  return safe;
}

}  // namespace

Tool sanitised(const Tool& tool) noexcept {
  Tool safe{sanitised(tool.head),
            {},
            tool.handpiece,
            tool.grips,
            tool.grips || tool.elevator > ElevatorKind::cryer_right ? ElevatorKind::none : tool.elevator};
  if (!safe.luxates() && tool.hand_instrument <= HandInstrument::root_plugger)
    safe.hand_instrument = tool.hand_instrument;
  if (!safe.luxates() && !safe.isHandInstrument()) safe.file = sanitised(tool.file);
  const Shaft& shaft = tool.shaft;
  if (shaft.radius_mm > 0.0 && shaft.length_mm > 0.0 && std::isfinite(shaft.radius_mm) &&
      std::isfinite(shaft.length_mm))
    safe.shaft = {std::min(shaft.radius_mm, kThickestShaft_mm), std::min(shaft.length_mm, kLongestShaft_mm)};
  return safe;
}

Tool forcepsTool() noexcept { return {{ShapeKind::sphere, kBetweenBeaks_mm, 0.0}, {}, false, true}; }

Tool elevatorTool(ElevatorKind kind) noexcept {
  const bool straight = kind == ElevatorKind::straight_301 || kind == ElevatorKind::straight_34s;
  const Shaft along_blade = straight ? Shaft{kBladeHalf_mm, kBladeAndShank_mm} : Shaft{};
  return {{ShapeKind::sphere, kBladeHalf_mm, 0.0}, along_blade, false, false, kind};
}

Tool handInstrumentTool(HandInstrument kind) noexcept {
  const HandInstrumentSize& size = kHandInstrumentSizes[static_cast<std::size_t>(kind)];
  return {.head = {ShapeKind::sphere, size.tip_radius_mm, 0.0},
          .shaft = {size.shank_radius_mm, size.length_mm},
          .handpiece = false,
          .hand_instrument = kind};
}

Tool fileTool(const CanalFile& file) noexcept {
  return {.head = {ShapeKind::sphere, kFileHandleRadius_mm, 0.0}, .shaft = {}, .handpiece = false, .file = file};
}

Shaft standardShaft(const BurShape& head) noexcept {
  return {std::min(kShankRadius_mm, kNeckPart * head.radius_mm), kOutOfHandpiece_mm};
}

}  // namespace haptics
