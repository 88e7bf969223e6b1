#include "app/session/field_clarity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/tissue.h"

namespace app {
namespace {

// Film of water: moist bone under suction, flooded under the spray; dries slowly without water.
constexpr double kMoist = 0.35, kDry = 0.12;
constexpr double kWets_s = 0.4, kDrains_s = 3.0, kDries_s = 25.0;

// Chips of dry cutting; this much covers 63 % of the site. Water carries them to the sucker.
constexpr double kCovers_mm3 = 2.5, kWashes_s = 0.7, kFalls_s = 90.0;

// Marrow oozes to a level set by how much of it is open; water dilutes it.
constexpr double kOozing = 0.15, kBleeding = 0.95, kOpenMarrow_mm3 = 6.0;
constexpr double kWells_s = 4.0, kDiluted = 0.35, kDilutes_s = 0.8;

constexpr double kSprayRises_s = 0.1, kSprayFalls_s = 0.3;

// How much of the view each takes at its full share.
constexpr double kDustHides = 0.75, kBloodHides = 0.55, kSprayHides = 0.15;

// The cover's middle follows the bur with the bone that it removes.
constexpr double kFollows_mm3 = 3.0, kLeastReach_mm = 5.0, kMostReach_mm = 11.0;

// Towards `goal` with a time constant.
double approached(double value, double goal, double dt_s, double constant_s) {
  return goal + (value - goal) * std::exp(-dt_s / constant_s);
}

}  // namespace

double FieldCover::clarity() const {
  return (1.0 - kDustHides * dust) * (1.0 - kBloodHides * blood) * (1.0 - kSprayHides * spray);
}

void FieldClarity::step(const haptics::Tick& tick, bool irrigating) {
  const double end_s = tick.t_s + tick.dt_s, dt_s = std::max(0.0, end_s - t_s_);
  if (dt_s <= 0.0) return;
  t_s_ = end_s;
  const bool spraying = irrigating && tick.drilling;  // the pump runs with the motor

  // Hard tissue removed since the last step; what undo returns was never cut.
  double removed_mm3 = 0.0;
  for (std::size_t tissue = 0; tissue < tick.removed_total_mm3.size(); ++tissue)
    if (assets::isHard(static_cast<std::uint8_t>(tissue))) removed_mm3 += tick.removed_total_mm3[tissue];
  const double chips_mm3 = std::max(0.0, removed_mm3 - removed_mm3_);
  removed_mm3_ = removed_mm3;
  marrow_mm3_ = std::max(0.0, tick.removed_total_mm3[static_cast<std::size_t>(assets::Tissue::trabecular)]);
  centre_P_.mm += (1.0 - std::exp(-chips_mm3 / kFollows_mm3)) * (tick.proxy_P.mm - centre_P_.mm);

  cover_.spray = approached(cover_.spray, spraying ? 1.0 : 0.0, dt_s, spraying ? kSprayRises_s : kSprayFalls_s);
  if (spraying)
    cover_.water = approached(cover_.water, 1.0, dt_s, kWets_s);
  else if (cover_.water > kMoist)
    cover_.water = approached(cover_.water, kMoist - 0.02, dt_s, kDrains_s);
  else
    cover_.water = approached(cover_.water, kDry, dt_s, kDries_s);

  // Under water chips float off at once.
  chips_mm3_ = approached(chips_mm3_ + (spraying ? 0.0 : chips_mm3), 0.0, dt_s, spraying ? kWashes_s : kFalls_s);
  cover_.dust = 1.0 - std::exp(-chips_mm3_ / kCovers_mm3);

  const double wells = kOozing + (kBleeding - kOozing) * (1.0 - std::exp(-marrow_mm3_ / kOpenMarrow_mm3));
  cover_.blood = approached(cover_.blood, spraying ? kDiluted * wells : wells, dt_s, spraying ? kDilutes_s : kWells_s);
}

double FieldClarity::reach_mm() const {
  // The radius of a hemisphere of that volume, and as much around it.
  const double radius_mm = std::cbrt(1.5 * std::max(0.0, removed_mm3_) / std::numbers::pi);
  return std::clamp(2.0 * radius_mm, kLeastReach_mm, kMostReach_mm);
}

}  // namespace app
