// What an electronic apex locator says of a file's tip. The way along the canal that is left to the foramen, told with
// the error of the two-frequency quotient: 0.19 mm long in the mean, within half a millimetre of the constriction in
// 90.7 % of canals (Welk 2004, JOE 30:109), which makes a standard deviation of 0.23 mm from canal to canal; a flicker
// besides, and jumps where the canal is dry. Outside the tooth anywhere below its cervix the circuit is closed: APEX,
// be it foramen or perforation. A pure function of seed, place and time, so that a replay says the same. Not modelled:
// a file that touches metal. Frame P, mm, s. Any thread; some µs.
#pragma once

#include <cstdint>
#include <optional>

#include "app/procedure/root_canal/canal_tip.h"
#include "assets/ct_volume.h"

namespace app {

struct LocatorReading {
  static constexpr double kMost_mm = 3.0;  ///< where its scale begins
  enum class Place : std::uint8_t { canal, beyond, perforation };

  Place place = Place::canal;
  std::optional<std::size_t> canal;  ///< none: a perforation elsewhere
  double left_mm = kMost_mm;         ///< to the foramen as told, 0 to kMost_mm; 0 outside

  bool isApex() const { return place != Place::canal || left_mm <= 0.0; }
  bool operator==(const LocatorReading&) const = default;
};

class ApexLocator {
 public:
  enum class Mode : std::uint8_t { exact, real };
  static constexpr double kBias_mm = 0.19, kSpread_mm = 0.233, kFlicker_mm = 0.02, kDryJump_mm = 1.5;

  /// `scan`: the tooth before it was cut, borrowed.
  ApexLocator(const assets::ToothCanals& tooth, const assets::CtVolume& scan, Mode mode, std::uint64_t seed)
      : tooth_(tooth), scan_(scan), mode_(mode), seed_(seed) {}

  /// None: the tip is in no canal, the circuit is open.
  std::optional<LocatorReading> at(const glm::dvec3& tip_P_mm, double t_s, bool is_dry) const;

 private:
  bool isOutside(const glm::dvec3& tip_P_mm) const;
  double error_mm(std::size_t canal, double t_s, bool is_dry) const;

  const assets::ToothCanals& tooth_;
  const assets::CtVolume& scan_;
  Mode mode_;
  std::uint64_t seed_;
};

}  // namespace app
