#include "app/procedure/third_molar/flap_demonstration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kFlapOutside_mm = 45.0, kFlapOver_mm = 14.0;  // from the site: tools are turned; over a place
constexpr double kCuts_mm_per_s = 9.0, kRaises_mm_per_s = 12.0, kLowers_mm_per_s = 20.0;
constexpr double kPressed_mm = 0.35;  // the blade, into the bone's surface
constexpr double kFreed_mm = 1.3;
constexpr double kOverBone_mm = 0.1;     // the elevator's blade glides
constexpr double kOverFlapGum_mm = 1.5;  // from there straight down, and up to there
constexpr double kStrip_mm = 1.8;        // from one strip of raising to the next
constexpr double kBeyondBase_rad = 0.06;
constexpr double kOutwards = 1.0;
constexpr double kMostWait_s = 10.0;  // for the assistant

std::size_t placeOf(const std::vector<haptics::Tool>& tray, haptics::HandInstrument kind, const char* name) {
  const auto found = std::ranges::find(tray, kind, &haptics::Tool::hand_instrument);
  if (found == tray.end()) throw UsageError(std::string("--flap closed: the scripted hand needs --tool ") + name);
  return static_cast<std::size_t>(found - tray.begin());
}

}  // namespace

FlapDemonstration::FlapDemonstration(const GumChart& chart, const FlapPlan& plan, const assets::PlannedCut& cut,
                                     const std::vector<haptics::Tool>& tray, haptics::LedHand& hand,
                                     const haptics::LedPath& cutting)
    : chart_(chart),
      plan_(plan),
      tools_(tray),
      blade_(placeOf(tray, haptics::HandInstrument::scalpel_15, "scalpel:15")),
      elevator_(placeOf(tray, haptics::HandInstrument::periosteal, "periosteal")),
      hand_(hand),
      cutting_(cutting) {
  const glm::dvec3 way = glm::length(cut.sight_P) > 0.0 ? cut.sight_P : cut.outward_P;
  outside_P_mm_ = cut.surface_P_mm + kFlapOutside_mm * glm::normalize(way);
  R_PT_ = cutting_.script(0.0).rotation;
  shaft_P_ = R_PT_ * glm::dvec3(0.0, 0.0, 1.0);
}

/// Between the way in and straight out of the gum, so that neither ridge nor crown is met by the shank.
glm::dquat FlapDemonstration::heldAt(const ChartPlace& place) const {
  const glm::dvec3 wanted = glm::normalize(shaft_P_ + kOutwards * chart_.outward_P(place));
  return glm::normalize(glm::dquat(shaft_P_, wanted) * R_PT_);
}

HandPose FlapDemonstration::at(const ChartPlace& place, double over_bone_mm) const {
  return {heldAt(place), chart_.point_P_mm(place, chart_.bone_mm(place) + over_bone_mm)};
}

HandPose FlapDemonstration::atGum(const ChartPlace& place) const {
  return {heldAt(place), chart_.point_P_mm(place, chart_.gum_mm(place) + kOverFlapGum_mm)};
}

HandPose FlapDemonstration::above(const ChartPlace& place) const {
  HandPose over = atGum(place);
  over.translation_mm += kFlapOver_mm * shaft_P_;
  return over;
}

haptics::LedPath FlapDemonstration::incisionPath(const HandPose& from) const {
  const double over_mm = tools_[blade_].head.radius_mm - kPressed_mm;
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
  return joined(throughOutside(from, over, outside_P_mm_), keys.path());
}

/// Down each strip and back, under the gum all the time.
haptics::LedPath FlapDemonstration::raisingPath(const HandPose& from) const {
  const double over_mm = tools_[elevator_].head.radius_mm + kOverBone_mm;
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
  keys.moveTo({R_PT_, outside_P_mm_}, 3.0 * kLowers_mm_per_s);
  return joined(throughOutside(from, over, outside_P_mm_), keys.path());
}

std::optional<ControlRequest> FlapDemonstration::take(std::size_t tool, Phase next, const Frame& frame) {
  phase_ = next;
  since_s_ = frame.newest.t_s;
  if (frame.in_hand == tools_[tool]) return {};
  return ControlRequest{Control::tool, static_cast<int>(tool)};
}

std::optional<ControlRequest> FlapDemonstration::follow(const Frame& frame) {
  const HandPose hand = frame.newest.hand.X_PT;
  switch (phase_) {
    case Phase::beginning:
      if (frame.newest.dt_s == 0.0) return {};
      news_.push_back("incise to the bone");
      return take(blade_, Phase::taking_blade, frame);
    case Phase::taking_blade:
      if (!frame.is_applied) return {};
      lead(incisionPath(hand));
      phase_ = Phase::cutting;
      return {};
    case Phase::cutting:
      if (!hand_.hasArrived()) return {};
      news_.push_back("raise the flap");
      return take(elevator_, Phase::taking_elevator, frame);
    case Phase::taking_elevator:
      if (!frame.is_applied) return {};
      lead(raisingPath(hand));
      phase_ = Phase::raising;
      return {};
    case Phase::raising:
      if (!hand_.hasArrived()) return {};
      phase_ = Phase::waiting;
      since_s_ = frame.newest.t_s;
      return {};
    case Phase::waiting:
      if (frame.is_aside) return take(0, Phase::taking_bur, frame);
      if (frame.newest.t_s - since_s_ < kMostWait_s) return {};
      failure_ = "the flap could not be raised and held aside";
      phase_ = Phase::over;
      return {};
    case Phase::taking_bur: {
      if (!frame.is_applied) return {};
      const haptics::HandTarget start = cutting_.script(0.0);
      lead(throughOutside(hand, {start.rotation, start.position_mm}, outside_P_mm_));
      phase_ = Phase::nearing;
      return {};
    }
    case Phase::nearing:
      if (!hand_.hasArrived()) return {};
      phase_ = Phase::drilling;
      news_.push_back("bare the crown");
      lead(cutting_);
      return {};
    case Phase::drilling:
      if (hand_.hasArrived()) phase_ = Phase::over;
      return {};
    case Phase::over:
      return {};
  }
  return {};
}

std::optional<std::string> FlapDemonstration::news() {
  if (news_.empty()) return {};
  std::string line = std::move(news_.front());
  news_.pop_front();
  return line;
}

}  // namespace app
