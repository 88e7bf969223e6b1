// A hand that was planned beforehand: an instrument at places of a tooth's frame, how it leans and how fast it goes,
// and when it is changed; and how low the round or flat end of an upright one may go over a surface seen from the bite.
// Frame of the tooth, mm, s. Start-up only; a few hundred places a millisecond.
#pragma once

#include "app/device/pose_source.h"
#include "app/procedure/preparation/prepared_ideal.h"
#include "haptics/tool/tool.h"

namespace app {

class ScriptedHand {
 public:
  static constexpr double kAir_mm_per_s = 60.0;
  static constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

  explicit ScriptedHand(const assets::ToothFrame& frame) : frame_(frame) {}

  /// `name`: of the tray; the first thing that is taken lies in the hand already where nothing was done before.
  void take(const haptics::Tool& tool, const std::string& name);
  const haptics::BurShape& bur() const { return tool_.head; }

  /// The end of a bur, the tip's middle of another instrument; `shaft`: unit. `works`: pedal down on the way there.
  void go(const glm::dvec3& end_mm, const glm::dvec3& shaft, double mm_per_s, bool works);
  /// As it stands.
  void stay(double seconds, bool works);
  /// Straight up into the air.
  void lift(double clear_mm) { go({at_mm_.x, at_mm_.y, clear_mm}, kUp, kAir_mm_per_s, false); }
  /// Through the air to above a place.
  void goOver(const glm::dvec2& at_mm, double clear_mm, const glm::dvec3& shaft = kUp) {
    lift(clear_mm);
    go({at_mm, clear_mm}, shaft, kAir_mm_per_s, false);
  }
  const glm::dvec3& at_mm() const { return at_mm_; }
  HandScript done() { return std::move(script_); }

 private:
  assets::ToothFrame frame_;
  haptics::Tool tool_;
  double t_s_ = 0.0;
  glm::dvec3 at_mm_{0.0};
  HandScript script_;
};

/// How low the end of an upright bur may go over a map, staying `stock_mm` off it all around.
double lowestEnd_mm(const OcclusalMap& map, const glm::dvec2& at_mm, const haptics::BurShape& bur, double stock_mm);

}  // namespace app
