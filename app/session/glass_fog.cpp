#include "app/session/glass_fog.h"

#include <cmath>

namespace app {
namespace {

// Breath: as much in the mouth, whose air ends this far from the site; a warm glass clears outside it.
constexpr double kBreathVeils = 0.3, kMouthTo_mm = 50.0, kBreathMists_s = 15.0, kBreathClears_s = 3.0;
// Drops of the spray fall off with the distance from the bur; air dries them.
constexpr double kDropsVeil = 0.5, kSprayedTo_mm = 25.0, kDropsGather_s = 1.5, kDropsDry_s = 2.5;
constexpr double kWaterRinses_s = 1.0;

// Towards `goal` with a time constant.
double neared(double value, double goal, double dt_s, double constant_s) {
  return goal + (value - goal) * std::exp(-dt_s / constant_s);
}

}  // namespace

void GlassFog::step(double t_s, const Around& around) {
  const double dt_s = t_s - t_s_;
  if (!(dt_s > 0.0)) return;
  t_s_ = t_s;
  const bool in_mouth = around.from_site_mm < kMouthTo_mm;
  const bool is_sprayed = in_mouth && around.irrigating && around.drilling;  // the pump runs with the motor
  if (is_sprayed)
    breath_ = neared(breath_, 0.0, dt_s, kWaterRinses_s);
  else
    breath_ = neared(breath_, in_mouth ? kBreathVeils : 0.0, dt_s, in_mouth ? kBreathMists_s : kBreathClears_s);
  const double away = around.from_site_mm / kSprayedTo_mm;
  drops_ = neared(drops_, is_sprayed ? kDropsVeil * std::exp(-away * away) : 0.0, dt_s,
                  is_sprayed ? kDropsGather_s : kDropsDry_s);
}

}  // namespace app
