#include "app/procedure/root_canal/access_watch.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kBefore_s = 0.1, kAfter_s = 0.05, kFall_s = 0.25;
constexpr double kBesideChamber_mm = 2.5;  ///< farther from it a bur is no longer on its way in

}  // namespace

bool hasDepthBands(int fdi) {
  const int quadrant = fdi / 10, number = fdi % 10;
  return (quadrant == 3 || quadrant == 4) && number >= 6;
}

std::string roofDropText(const RoofDrop& drop) {
  return fmt::format("the roof of the chamber is open: {:.1f} N before, then {:.0f} mm/s, {:.1f} mm below it",
                     drop.force_N, drop.speed_mm_per_s, drop.plunge_mm);
}

std::optional<RoofDrop> AccessWatch::follow(const haptics::Tick& tick, const haptics::Tool& tool) {
  below_mm_.reset();
  const double now_s = tick.t_s + tick.dt_s;
  const glm::dvec3& up_P = tooth_.frame.axes_P[2];
  const double half_mm = tool.head.radius_mm + 0.5 * tool.head.length_mm;
  const glm::dvec3 end_P = tick.proxy_P.mm - half_mm * (tick.heldRotation() * glm::dvec3(0.0, 0.0, 1.0));
  const double under_roof_mm = tooth_.chamber.roof_mm - tooth_.frame.local(end_P).z;
  if (falling_) {
    // Also where the pedal was let go.
    falling_->plunge_mm = std::max(falling_->plunge_mm, under_roof_mm);
    if (!after_mm_ && now_s - falling_->t_s >= kAfter_s)
      after_mm_ = glm::dot(broke_P_mm_ - end_P, up_P), falling_->speed_mm_per_s = *after_mm_ / kAfter_s;
    if (now_s - falling_->t_s < kFall_s) return {};
    return std::exchange(falling_, {});
  }
  if (!tool.turns() || !tick.drilling) {
    past_.clear();
    return {};
  }
  const glm::dvec2 aside(tooth_.frame.local(end_P));
  const double beside_mm = assets::outlineDistance_mm(tooth_.chamber.outline_mm, aside) - tooth_.chamber.round_mm;
  const double below_mm = app::belowCusp_mm(tooth_, end_P);
  if (beside_mm < kBesideChamber_mm && below_mm > 0.0) below_mm_ = below_mm;

  past_.push_back({now_s, glm::length(tick.law_force_P_N.xyz)});
  while (past_.front().t_s < now_s - kBefore_s) past_.pop_front();
  if (is_open_ || pulp_.chamber_mm(end_P) > 0.0) return {};
  is_open_ = true;
  RoofDrop drop;
  drop.t_s = now_s;
  for (const Past& one : past_) drop.force_N = std::max(drop.force_N, one.force_N);
  drop.plunge_mm = std::max(0.0, under_roof_mm);
  falling_ = drop, broke_P_mm_ = end_P, after_mm_.reset();
  return {};
}

}  // namespace app
