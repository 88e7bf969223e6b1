// Phantoms with published geometry: link lengths, origin of D, limits. Sources (reference/devices 4.1):
//   Omni/Touch   l1 = l2 = 133.35 mm (5.25 in) from the literature; shoulder (0, 23.35, -168.35) unverified, but with
//                it all angles 0 are at (0, -110, -35), and the logged inkwell is within the limits. Limits: JHU's
//                URDF, from CAD.
//   Desktop/X    taken as the Omni's: nothing is published.
//   Premium 1.5  l1 = 209.55 (8.25 in), l2 = 169.545 mm (6.675 in); all angles 0 at D's origin. Limits: Cavusoglu,
//                Feygin, Tendick, Presence 2002. Gimbal limits are not published: the Omni's.
// None was measured on a unit here. Constants; any thread.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "calibration/arm/phantom_kinematics.h"
#include "calibration/geometry/units.h"

namespace calibration {

/// The URDF's limits (yaw 3.92..8.83, pitch -0.5..1.75, roll +-2.58) in the published ROS drivers' convention, shifted
/// to the gimbal's neutral at zero: g1 and g3 by half a turn, g2 mirrored.
inline constexpr std::array<AngleRange, 3> kOmniWrist = {{{-2.55, 2.36}, {-1.29, 0.96}, {-2.58, 2.58}}};

inline constexpr PhantomGeometry kOmniGeometry = {
    133.35, 133.35, {{0.0, 23.35, -168.35}}, {{{-0.98, 0.98}, {0.0, 1.75}, {}}}, {-0.81, 1.25}, kOmniWrist};

inline constexpr PhantomGeometry kDesktopGeometry = kOmniGeometry;

inline constexpr PhantomGeometry kPremium15Geometry = {209.55,
                                                       169.545,
                                                       {{0.0, 169.545, -209.55}},
                                                       {{{radFromDegrees(-90.0), radFromDegrees(90.0)},
                                                         {radFromDegrees(-124.0), radFromDegrees(119.0)},
                                                         {radFromDegrees(-29.0), radFromDegrees(214.0)}}},
                                                       {radFromDegrees(-65.0), radFromDegrees(55.0)},
                                                       kOmniWrist};

/// Keys in observations and rig files.
struct PhantomModel {
  std::string_view key;
  PhantomGeometry geometry;
};
inline constexpr std::array<PhantomModel, 4> kPhantomModels = {{{"omni", kOmniGeometry},
                                                                {"touch", kOmniGeometry},
                                                                {"desktop", kDesktopGeometry},
                                                                {"premium", kPremium15Geometry}}};

/// Null: unknown model.
constexpr const PhantomModel* findPhantomModel(std::string_view key) {
  for (const PhantomModel& model : kPhantomModels)
    if (model.key == key) return &model;
  return nullptr;
}

/// "omni, touch, desktop, premium", for messages.
inline std::string phantomModelKeys() {
  std::string keys;
  for (const PhantomModel& model : kPhantomModels) keys += (keys.empty() ? "" : ", ") + std::string(model.key);
  return keys;
}

/// Position of an Omni in its inkwell, logged by others with the vendor's library.
inline constexpr Point<Device> kOmniInkwell_D = {{0.0, -65.51071, -88.11420}};

}  // namespace calibration
