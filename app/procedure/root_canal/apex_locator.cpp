#include "app/procedure/root_canal/apex_locator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/tissue.h"

namespace app {
namespace {

/// SplitMix64 (Steele 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Above 0, at most 1.
double uniform(std::uint64_t key) { return (static_cast<double>(mixed(key) >> 11) + 1.0) * 0x1p-53; }

/// Box and Muller.
double normal(std::uint64_t key) {
  return std::sqrt(-2.0 * std::log(uniform(key))) * std::cos(2.0 * std::numbers::pi * uniform(key ^ 0x5bd1e995u));
}

std::uint64_t slice(double t_s, double length_s) {
  return static_cast<std::uint64_t>(std::max(0.0, std::floor(t_s / length_s)));
}

}  // namespace

bool ApexLocator::isOutside(const glm::dvec3& tip_P_mm) const {
  if (tooth_.frame.local(tip_P_mm).z > tooth_.chamber.floor_mm) return false;
  const glm::ivec3 ijk(glm::round(scan_.grid.indexFromPoint(tip_P_mm)));
  if (!scan_.grid.contains(ijk)) return true;
  const std::uint8_t label = scan_.label[scan_.grid.index(ijk)];
  return label != 0 && !assets::isTooth(label);
}

double ApexLocator::error_mm(std::size_t canal, double t_s, bool is_dry) const {
  if (mode_ == Mode::exact) return 0.0;
  constexpr double kFlicker_s = 0.2, kJump_s = 0.35;
  const std::uint64_t key = mixed(seed_) + 1000 * canal;
  double error = kBias_mm + kSpread_mm * normal(key) + kFlicker_mm * normal(mixed(key + 1) + slice(t_s, kFlicker_s));
  if (is_dry) error += kDryJump_mm * (2.0 * uniform(mixed(key + 2) + slice(t_s, kJump_s)) - 1.0);
  return error;
}

std::optional<LocatorReading> ApexLocator::at(const glm::dvec3& tip_P_mm, double t_s, bool is_dry) const {
  using Place = LocatorReading::Place;
  const auto tip = canalTip(tooth_, tip_P_mm);
  const double left_mm = tip ? tooth_.canals[tip->canal].length_mm() - tip->along_mm : 0.0;
  if (tip && left_mm < 0.0) return LocatorReading{Place::beyond, tip->canal, 0.0};
  if (isOutside(tip_P_mm))
    return LocatorReading{Place::perforation, tip ? std::optional(tip->canal) : std::nullopt, 0.0};
  if (!tip) return {};
  return LocatorReading{Place::canal, tip->canal,
                        std::clamp(left_mm + error_mm(tip->canal, t_s, is_dry), 0.0, LocatorReading::kMost_mm)};
}

}  // namespace app
