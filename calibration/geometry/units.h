// Units: mm, N, N/mm, s, rad, Hounsfield. Foreign units are converted on the line where they enter. Any thread. Not a
// unit library: the suffix of a name (`radius_mm`) states the unit.
#pragma once

#include <numbers>

namespace calibration {

inline constexpr double kPi = std::numbers::pi;

/// glTF and OpenXR lengths are metres.
constexpr double mmFromMetres(double length_m) { return length_m * 1000.0; }
constexpr double metresFromMm(double length_mm) { return length_mm / 1000.0; }
constexpr double radFromDegrees(double angle_deg) { return angle_deg * kPi / 180.0; }
constexpr double degreesFromRad(double angle_rad) { return angle_rad * 180.0 / kPi; }

}  // namespace calibration
