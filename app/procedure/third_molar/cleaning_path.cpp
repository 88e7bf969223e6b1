#include "app/procedure/third_molar/cleaning_path.h"

#include <cmath>

#include "app/procedure/third_molar/led_keys.h"

namespace app {
namespace {

constexpr double kOverSite_mm = 16.0,
                 kOverCrown_mm = 14.0;  // of a place: out of the socket; past the next tooth's crown
constexpr double kTravels_mm_per_s = 90.0, kNears_mm_per_s = 60.0, kDraws_mm_per_s = 36.0, kTurns_rad_per_s = 3.0;
constexpr double kSucks_s = 0.6, kConfirms_s = 0.5;
constexpr double kScrapes_mm = 2.0, kFiles_mm = 1.3;  ///< pressed beyond the surface
constexpr double kLifts_mm = 0.4;                     ///< off it, before and after
constexpr double kGives_mm = 0.3;                     ///< beyond what is pressed, before the hand waits
constexpr double kBeyondEnd_mm = 0.6;
constexpr int kDraws = 2, kFileDraws = 3;

glm::dquat heldAt(const CleaningPlace& place, const glm::dquat& R_PT) {
  return glm::normalize(glm::dquat(R_PT * glm::dvec3(0.0, 0.0, 1.0), place.shaft_P) * R_PT);
}

/// Of the tip, off what it works on.
glm::dvec3 firstMiddle_mm(const CleaningPlace& place, double tip_radius_mm) {
  const glm::dvec3& first = place.way_P_mm.front();
  return place.into_P.empty() ? first : first - (tip_radius_mm + kLifts_mm) * place.into_P.front();
}

class Worker {
 public:
  Worker(LedKeys& keys, const CleaningStep& step, double tip_radius_mm, const glm::dquat& R_PT)
      : keys_(keys), step_(step), tip_radius_mm_(tip_radius_mm), R_PT_(R_PT) {}

  void workAt(const CleaningPlace& place) {
    const glm::dvec3 first = firstMiddle_mm(place, tip_radius_mm_);
    const double over_mm = step_.what == Cleaning::stitch ? kOverCrown_mm : kOverSite_mm;
    const HandPose above{heldAt(place), first + over_mm * place.shaft_P};
    keys_.moveTo(above, kTravels_mm_per_s, kTurns_rad_per_s);
    keys_.moveTo({heldAt(place), first}, kNears_mm_per_s);
    switch (step_.what) {
      case Cleaning::suction:
        keys_.hold(kSucks_s);
        break;
      case Cleaning::curette:
        draw(place, kScrapes_mm, kDraws);
        break;
      case Cleaning::file:
        draw(place, kFiles_mm, kFileDraws);
        break;
      case Cleaning::stitch:
        keys_.press(true);
        keys_.hold(kConfirms_s);
        keys_.press(false);
        break;
    }
    keys_.moveTo(above, kTravels_mm_per_s);
  }

 private:
  glm::dquat heldAt(const CleaningPlace& place) const { return app::heldAt(place, R_PT_); }
  /// To and fro, pressed, a little beyond the ends.
  void draw(const CleaningPlace& place, double pressed_mm, int times) {
    const std::vector<glm::dvec3>& way = place.way_P_mm;
    const glm::dvec3 run = way.back() - way.front();
    const glm::dvec3 beyond = glm::length(run) > 0.1 ? kBeyondEnd_mm * glm::normalize(run) : glm::dvec3(0.0);
    const glm::dquat held = heldAt(place);
    for (const glm::dvec3& into : place.into_P) {
      const glm::dvec3 lifted = -(tip_radius_mm_ + kLifts_mm) * into, pressed = (pressed_mm - tip_radius_mm_) * into;
      keys_.moveTo({held, way.front() + lifted}, kNears_mm_per_s);
      for (int n = 0; n < times; ++n) {
        for (const glm::dvec3& p : way) keys_.moveTo({held, p + pressed}, kDraws_mm_per_s);
        keys_.moveTo({held, way.back() + beyond + pressed}, kDraws_mm_per_s);
        for (auto p = way.rbegin(); p != way.rend(); ++p) keys_.moveTo({held, *p + pressed}, kDraws_mm_per_s);
        keys_.moveTo({held, way.front() - beyond + pressed}, kDraws_mm_per_s);
      }
      keys_.moveTo({held, way.front() + lifted}, kNears_mm_per_s);
    }
  }

  LedKeys& keys_;
  const CleaningStep& step_;
  double tip_radius_mm_;
  glm::dquat R_PT_;
};

}  // namespace

haptics::LedPath cleaningPath(const HandPose& from, const glm::dvec3& outside_P_mm, const CleaningStep& step,
                              double tip_radius_mm, const glm::dquat& R_PT) {
  const CleaningPlace& first = step.places.front();
  const HandPose over{heldAt(first, R_PT), firstMiddle_mm(first, tip_radius_mm) + kOverSite_mm * first.shaft_P};
  LedKeys keys(over);
  Worker worker(keys, step, tip_radius_mm, R_PT);
  for (const CleaningPlace& place : step.places) worker.workAt(place);
  haptics::LedPath path = joined(throughOutside(from, over, outside_P_mm), keys.path());
  path.patient_mm = kGives_mm + (step.what == Cleaning::curette ? kScrapes_mm : kFiles_mm);
  return path;
}

}  // namespace app
