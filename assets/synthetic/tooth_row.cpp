#include "assets/synthetic/tooth_row.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace assets {
namespace {

// Per position: arc length at the centre of the tooth, crown height, lean.
constexpr std::array<double, 8> kAlong_mm = {0.0, 2.7, 8.35, 14.75, 21.75, 28.85, 38.05, 48.95};
constexpr std::array<double, 8> kCrownHeight_mm = {0.0, 9.0, 9.5, 11.0, 8.5, 8.0, 7.6, 7.2};
constexpr std::array<double, 8> kLingualLean_deg = {0.0, 0.0, 0.0, 0.0, 4.0, 6.0, 9.0, 10.0};
constexpr double kContactGap_mm = 0.35;
constexpr double kThirdMolarBuccal_mm = 0.6;
constexpr double kThirdMolarLean_deg = 5.0;
constexpr double kThirdMolarRoll_deg = 7.0;

/// Axes of a tooth leaning lingually, tipped mesially and rolled about its axis.
glm::dmat3 toothAxes(const ArchStation& station, double lean_deg, double tip_deg, double roll_deg) {
  const glm::dvec3 mesial(-station.distal, 0.0), buccal(station.buccal, 0.0), up(0.0, 0.0, 1.0);
  const double tip = calibration::radFromDegrees(tip_deg), lean = calibration::radFromDegrees(lean_deg),
               roll = calibration::radFromDegrees(roll_deg);
  const glm::dvec3 tipped_up = std::cos(tip) * up + std::sin(tip) * mesial;
  const glm::dvec3 tipped_mesial = std::cos(tip) * mesial - std::sin(tip) * up;
  const glm::dvec3 occlusal = std::cos(lean) * tipped_up - std::sin(lean) * buccal;
  const glm::dvec3 leaning_buccal = std::cos(lean) * buccal + std::sin(lean) * tipped_up;
  return {std::cos(roll) * tipped_mesial + std::sin(roll) * leaning_buccal,
          std::cos(roll) * leaning_buccal - std::sin(roll) * tipped_mesial, occlusal};
}

double highest_mm(const std::vector<glm::dvec3>& surface, const PlacedTooth& tooth) {
  double top_mm = -1e9;
  for (const glm::dvec3& p : surface) top_mm = std::max(top_mm, tooth.inJaw(p).z);
  return top_mm;
}

}  // namespace

PlacedTooth eruptedTooth(const DentalArch& arch, int position) {
  const auto n = static_cast<std::size_t>(position);
  const ArchStation station = arch.stationAt(kAlong_mm[n]);
  PlacedTooth tooth{position, lowerToothShape(position), glm::dvec3(station.centre_mm, -kCrownHeight_mm[n]),
                    toothAxes(station, kLingualLean_deg[n], 0.0, 0.0)};
  // The lean moves the crown lingually: move its middle back onto the arch, and the cusps onto the plane.
  tooth.cervix_J_mm += 0.35 * std::sin(calibration::radFromDegrees(kLingualLean_deg[n])) * kCrownHeight_mm[n] *
                       glm::dvec3(station.buccal, 0.0);
  tooth.cervix_J_mm.z -= highest_mm(tooth.shape.surfacePoints_mm(), tooth);
  return tooth;
}

PlacedTooth impactedThirdMolar(const DentalArch& arch, const PlacedTooth& second_molar, double winter_angle_deg,
                               double depth_mm) {
  const ArchStation station = arch.stationAt(kAlong_mm[7] + 9.0);
  PlacedTooth tooth{8, lowerToothShape(8), glm::dvec3(station.centre_mm + kThirdMolarBuccal_mm * station.buccal, 0.0),
                    toothAxes(station, kThirdMolarLean_deg, winter_angle_deg, kThirdMolarRoll_deg)};
  const std::vector<glm::dvec3> surface = tooth.shape.surfacePoints_mm();
  tooth.cervix_J_mm.z = -depth_mm - highest_mm(surface, tooth);

  // Bisect the shift between overlap (forward) and a gap (backward).
  const glm::dvec3 start_mm = tooth.cervix_J_mm, back(station.distal, 0.0);
  const auto gap_at = [&](double shift_mm) {
    double gap_mm = 1e9;
    for (std::size_t n = 0; n < surface.size(); n += 3) {
      const glm::dvec3 p_J = start_mm + shift_mm * back + tooth.axes_J * surface[n];
      gap_mm = std::min(gap_mm, second_molar.shape.outer_mm(second_molar.local(p_J)));
    }
    return gap_mm;
  };
  double near_mm = -8.0, far_mm = 25.0;
  for (int halving = 0; halving < 16; ++halving) {
    const double middle_mm = 0.5 * (near_mm + far_mm);
    (gap_at(middle_mm) < kContactGap_mm ? near_mm : far_mm) = middle_mm;
  }
  tooth.cervix_J_mm = start_mm + far_mm * back;
  return tooth;
}

}  // namespace assets
