#include "app/procedure/third_molar/cleaning_path.h"

#include <cmath>

#include "app/procedure/third_molar/led_keys.h"

namespace app {
namespace {

// Above a place, from one to the next: in the socket, and across the crown of the tooth before it.
constexpr double kOverSite_mm = 16.0, kBetween_mm = 5.0, kOverCrown_mm = 14.0;
constexpr double kTravels_mm_per_s = 60.0, kNears_mm_per_s = 25.0, kDraws_mm_per_s = 20.0;
constexpr double kSucks_s = 0.35, kConfirms_s = 0.5;
constexpr double kOffPlace_mm = 0.6;                   ///< the opening over what it takes
constexpr double kAgainst_mm = 0.25, kDrawn_mm = 1.5;  ///< curette: into the wall, to either side
constexpr double kFilePressed_mm = 0.7, kFileBeyond_mm = 1.0;
constexpr int kDraws = 2, kFileDraws = 4;

/// The place where the middle of the head belongs for a work at `p`.
class Worker {
 public:
  Worker(LedKeys& keys, const CleaningStep& step, const haptics::Tool& tool, const glm::dquat& R_PT)
      : keys_(keys), step_(step), tool_(tool), R_PT_(R_PT) {}

  void workAt(const std::vector<glm::dvec3>& way) {
    switch (step_.what) {
      case Cleaning::suction:
        return suck(way.front());
      case Cleaning::curette:
        return scrape(way.front());
      case Cleaning::file:
        return file(way);
      case Cleaning::stitch:
        return confirm(way.front());
    }
  }

 private:
  HandPose at(const glm::dvec3& p) const { return {R_PT_, p}; }
  void approach(const glm::dvec3& p, double above_mm = kBetween_mm) {
    keys_.moveTo(at(p + above_mm * step_.out_P), kTravels_mm_per_s);
    keys_.moveTo(at(p), kNears_mm_per_s);
  }
  void leave(const glm::dvec3& p, double above_mm = kBetween_mm) {
    keys_.moveTo(at(p + above_mm * step_.out_P), kTravels_mm_per_s);
  }

  void suck(const glm::dvec3& p) {
    const glm::dvec3 here = p + tool_.head.radius_mm * (R_PT_ * glm::dvec3(0, 0, 1)) + kOffPlace_mm * step_.out_P;
    approach(here);
    keys_.hold(kSucks_s);
    leave(here);
  }
  /// The wall lies away from the middle of the socket.
  void scrape(const glm::dvec3& p) {
    const glm::dvec3 away = p - step_.middle_P_mm;
    const glm::dvec3 n = glm::length(away) > 0.1 ? glm::normalize(away) : -step_.out_P;
    const glm::dvec3 here = p - (tool_.head.radius_mm - kAgainst_mm) * n;
    glm::dvec3 along = step_.out_P - glm::dot(step_.out_P, n) * n;
    along = glm::length(along) > 0.2 ? glm::normalize(along) : glm::normalize(glm::cross(n, glm::dvec3(1.0, 0.3, 0.0)));
    approach(here);
    for (int n_draw = 0; n_draw < kDraws; ++n_draw)
      for (const double side : {1.0, -1.0}) keys_.moveTo(at(here + side * kDrawn_mm * along), kDraws_mm_per_s);
    leave(here);
  }
  /// To and fro along the edge, a little beyond its ends, from straight above and from either side of it.
  void file(const std::vector<glm::dvec3>& way) {
    const glm::dvec3 run =
        way.size() > 1 ? way.back() - way.front() : glm::cross(step_.out_P, glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec3 along = glm::normalize(run), side = glm::normalize(glm::cross(step_.out_P, along));
    const double off_mm = tool_.head.radius_mm - kFilePressed_mm;
    for (const double lean : {0.0, 0.7, -0.7}) {
      const glm::dvec3 lift = off_mm * glm::normalize(step_.out_P + lean * side);
      approach(way.front() + lift);
      for (int draw = 0; draw < kFileDraws; ++draw) {
        const bool back = draw % 2 == 1;
        for (std::size_t n = 0; n < way.size(); ++n)
          keys_.moveTo(at(way[back ? way.size() - 1 - n : n] + lift), kDraws_mm_per_s);
        keys_.moveTo(at((back ? way.front() - kFileBeyond_mm * along : way.back() + kFileBeyond_mm * along) + lift),
                     kDraws_mm_per_s);
      }
      leave(way.front() + lift);
    }
  }
  void confirm(const glm::dvec3& p) {
    approach(p, kOverCrown_mm);
    keys_.press(true);
    keys_.hold(kConfirms_s);
    keys_.press(false);
    leave(p, kOverCrown_mm);
  }

  LedKeys& keys_;
  const CleaningStep& step_;
  const haptics::Tool& tool_;
  glm::dquat R_PT_;
};

}  // namespace

haptics::LedPath cleaningPath(const HandPose& from, const glm::dvec3& outside_P_mm, const CleaningStep& step,
                              const haptics::Tool& tool, const glm::dquat& R_PT) {
  const glm::dvec3 first = step.ways_P_mm.front().front(), last = step.ways_P_mm.back().back();
  const HandPose over{R_PT, first + kOverSite_mm * step.out_P};
  LedKeys keys(over);
  Worker worker(keys, step, tool, R_PT);
  for (const std::vector<glm::dvec3>& way : step.ways_P_mm) worker.workAt(way);
  keys.moveTo({R_PT, last + kOverSite_mm * step.out_P}, kTravels_mm_per_s);
  return joined(throughOutside(from, over, outside_P_mm), keys.path());
}

}  // namespace app
