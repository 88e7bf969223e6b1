#include "app/procedure/third_molar/flap_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kFlapOver_mm = 14.0;  // over a place
constexpr double kCuts_mm_per_s = 12.0, kRaises_mm_per_s = 20.0, kLowers_mm_per_s = 20.0;
constexpr double kPressed_mm = 0.35;  // the blade, into the bone's surface
constexpr double kFreed_mm = 1.3;
constexpr double kOverBone_mm = 0.1;     // the elevator's blade glides
constexpr double kOverFlapGum_mm = 1.5;  // from there straight down, and up to there
constexpr double kStrip_mm = 1.8;        // from one strip of raising to the next
constexpr double kBeyondBase_rad = 0.06;
constexpr double kOutwards = 1.0;

std::size_t placeOf(const std::vector<haptics::Tool>& tray, haptics::HandInstrument kind, const char* name) {
  const auto found = std::ranges::find(tray, kind, &haptics::Tool::hand_instrument);
  if (found == tray.end()) throw UsageError(std::string("--flap closed: the scripted hand needs --tool ") + name);
  return static_cast<std::size_t>(found - tray.begin());
}

}  // namespace

FlapWork::FlapWork(const GumChart& chart, const FlapPlan& plan, const std::vector<haptics::Tool>& tray,
                   const glm::dquat& R_PT)
    : chart_(chart),
      plan_(plan),
      blade_(placeOf(tray, haptics::HandInstrument::scalpel_15, "scalpel:15")),
      elevator_(placeOf(tray, haptics::HandInstrument::periosteal, "periosteal")),
      blade_radius_mm_(tray[blade_].head.radius_mm),
      elevator_radius_mm_(tray[elevator_].head.radius_mm),
      shaft_P_(R_PT * glm::dvec3(0.0, 0.0, 1.0)),
      R_PT_(R_PT) {}

/// Between the way in and straight out of the gum, so that neither ridge nor crown is met by the shank.
glm::dquat FlapWork::heldAt(const ChartPlace& place) const {
  const glm::dvec3 wanted = glm::normalize(shaft_P_ + kOutwards * chart_.outward_P(place));
  return glm::normalize(glm::dquat(shaft_P_, wanted) * R_PT_);
}

HandPose FlapWork::at(const ChartPlace& place, double over_bone_mm) const {
  return {heldAt(place), chart_.point_P_mm(place, chart_.bone_mm(place) + over_bone_mm)};
}

HandPose FlapWork::atGum(const ChartPlace& place) const {
  return {heldAt(place), chart_.point_P_mm(place, chart_.gum_mm(place) + kOverFlapGum_mm)};
}

HandPose FlapWork::above(const ChartPlace& place) const {
  HandPose over = atGum(place);
  over.translation_mm += kFlapOver_mm * shaft_P_;
  return over;
}

haptics::LedPath FlapWork::incisionPath(const HandPose& from, const glm::dvec3& outside_P_mm) const {
  const double over_mm = blade_radius_mm_ - kPressed_mm;
  const HandPose over = above(plan_.incision().front());
  LedKeys keys(over);
  keys.moveTo(atGum(plan_.incision().front()), kLowers_mm_per_s);
  // Back and forth; a little up at every second place, where the blade catches on bone or tooth.
  const std::vector<ChartPlace>& line = plan_.incision();
  for (std::size_t n = 0; n < 2 * line.size(); ++n) {
    const ChartPlace& place = line[n < line.size() ? n : 2 * line.size() - 1 - n];
    keys.moveTo(at(place, over_mm), kCuts_mm_per_s);
    if (n % 2 == 0) continue;
    keys.moveTo(at(place, over_mm + kFreed_mm), kLowers_mm_per_s);
    keys.moveTo(at(place, over_mm), kLowers_mm_per_s);
  }
  keys.moveTo(atGum(line.front()), kLowers_mm_per_s);
  keys.moveTo(above(line.front()), kLowers_mm_per_s);
  return joined(throughOutside(from, over, outside_P_mm), keys.path());
}

/// Down each strip and back, under the gum all the time.
haptics::LedPath FlapWork::raisingPath(const HandPose& from, const glm::dvec3& outside_P_mm) const {
  const double over_mm = elevator_radius_mm_ + kOverBone_mm;
  const std::vector<ChartPlace>& line = plan_.incision();
  std::vector<ChartPlace> tops;
  for (double m_mm = line.front().m_mm + 0.5 * kStrip_mm; m_mm < line.back().m_mm; m_mm += kStrip_mm) {
    const auto near =
        std::ranges::min_element(line, {}, [&](const ChartPlace& place) { return std::abs(place.m_mm - m_mm); });
    tops.push_back({m_mm, near->angle_rad});
  }
  const HandPose over = above(tops.front());
  LedKeys keys(over);
  keys.moveTo(atGum(tops.front()), kLowers_mm_per_s);
  for (const ChartPlace& top : tops) {
    const ChartPlace base{top.m_mm, std::max(top.angle_rad + 0.1, plan_.base_rad() + kBeyondBase_rad)};
    const int steps = std::max(2, static_cast<int>((base.angle_rad - top.angle_rad) / 0.05));
    keys.moveTo(at(top, over_mm), kRaises_mm_per_s);
    for (int n = 1; n <= 2 * steps; ++n) {
      const double part = n <= steps ? static_cast<double>(n) / steps : 2.0 - static_cast<double>(n) / steps;
      keys.moveTo(at({top.m_mm, top.angle_rad + part * (base.angle_rad - top.angle_rad)}, over_mm), kRaises_mm_per_s);
    }
  }
  keys.moveTo(atGum(tops.back()), kLowers_mm_per_s);
  keys.moveTo(above(tops.back()), kLowers_mm_per_s);
  keys.moveTo({R_PT_, outside_P_mm}, 3.0 * kLowers_mm_per_s);
  return joined(throughOutside(from, over, outside_P_mm), keys.path());
}

}  // namespace app
