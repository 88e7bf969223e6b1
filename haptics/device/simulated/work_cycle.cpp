#include "haptics/device/simulated/work_cycle.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr double kLies_s = 0.3, kTakes_s = 0.2, kWaits_s = 1.0;
constexpr double kMean_mm_per_s = 80.0;

}  // namespace

WorkCycle::WorkCycle(const TroughPath& work, const HandTarget& rest, const std::vector<glm::dvec3>& way)
    : work_(work), rest_(rest), start_(work.at(0.0)) {
  glm::dvec3 from_mm = rest.position_mm;
  std::vector<glm::dvec3> places = way;
  places.push_back(start_.position_mm);
  for (const glm::dvec3& to_mm : places) {
    const double takes_s = std::max(glm::distance(from_mm, to_mm) / kMean_mm_per_s, 1e-3);
    legs_.push_back({from_mm, to_mm, way_s_, takes_s});
    way_s_ += takes_s;
    from_mm = to_mm;
  }
  works_s_ = kLies_s + kTakes_s + way_s_ + kWaits_s;
  leaves_s_ = works_s_ + work_.duration_s() + kTakes_s;
  duration_s_ = leaves_s_ + 1.0 + way_s_ + kTakes_s + kLies_s;
}

HandTarget WorkCycle::onTheWay(double t_s) const {
  const double t = std::clamp(t_s, 0.0, way_s_);
  const Leg& leg =
      *std::find_if(legs_.begin(), legs_.end() - 1, [&](const Leg& one) { return t < one.begins_s + one.takes_s; });
  HandTarget target;
  target.position_mm = glm::mix(leg.from_mm, leg.to_mm, eased(std::clamp((t - leg.begins_s) / leg.takes_s, 0.0, 1.0)));
  target.rotation = glm::slerp(rest_.rotation, start_.rotation, eased(t / way_s_));
  return target;
}

HandTarget WorkCycle::at(double t_s) const {
  if (t_s >= works_s_ && t_s < leaves_s_) return work_.at(t_s - works_s_);
  HandTarget target;
  if (t_s < works_s_) {
    target = onTheWay(t_s - kLies_s - kTakes_s);
  } else {
    // The work ends at the other end of the stroke.
    const double back_s = t_s - leaves_s_;
    target = onTheWay(way_s_ + 1.0 - std::max(back_s, 1.0));
    if (back_s < 1.0) {
      target = work_.at(work_.duration_s());
      target.position_mm = glm::mix(target.position_mm, start_.position_mm, eased(std::max(back_s, 0.0)));
    }
  }
  target.pedal = false;
  target.grips = t_s >= kLies_s && t_s < duration_s_ - kLies_s;
  return target;
}

}  // namespace haptics
