#include "app/rehearsal/soft_mark_trail.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

using render::Reddened;
using render::SoftCut;

constexpr double kStep = 0.5;  // of the head's radius, between two entries
constexpr double kJump = 4.0;  // of the same, in one tick: no cutting leads there
constexpr double kStraight_mm = 0.1;
constexpr double kCovered_mm = 0.15;
constexpr double kConeRadius = 0.6;  // of its base: a ball that fits along most of it

constexpr double kRedReach_mm = 3.5, kSamePlace_mm = 3.0;
constexpr double kReddens_s = 0.3, kFades_s = 0.8, kFollows_s = 0.3;
constexpr double kFullDepth_mm = 0.6;  // 63 % of the redness
constexpr double kUnseen = 0.02;

/// The head as a ball swept along its axis.
SoftCut headAt(const haptics::Tick& tick, const haptics::BurShape& head) {
  const bool is_cone = head.kind == haptics::ShapeKind::cone;
  const double widest_mm = head.kind == haptics::ShapeKind::revolved ? haptics::largestBall_mm(head) : head.radius_mm;
  const double radius_mm = is_cone ? kConeRadius * widest_mm : widest_mm;
  const double half_mm = std::max(0.0, haptics::halfHeight_mm(head) - radius_mm);
  const glm::dvec3 along = tick.heldRotation() * glm::dvec3(0.0, 0.0, half_mm);
  return {{tick.proxy_P.mm - along}, {tick.proxy_P.mm + along}, radius_mm};
}

double moved_mm(const SoftCut& a, const SoftCut& b) {
  return std::max(glm::distance(a.from_P.mm, b.from_P.mm), glm::distance(a.to_P.mm, b.to_P.mm));
}

double toLine_mm(const glm::dvec3& p_P_mm, const glm::dvec3& from_P_mm, const glm::dvec3& to_P_mm) {
  const glm::dvec3 way = to_P_mm - from_P_mm, offset = p_P_mm - from_P_mm;
  const double at = std::clamp(glm::dot(offset, way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
  return glm::length(offset - at * way);
}

/// By how much `cut` reaches out of `by`, mm.
double uncovered_mm(const SoftCut& cut, const SoftCut& by) {
  return std::max(toLine_mm(cut.from_P.mm, by.from_P.mm, by.to_P.mm),
                  toLine_mm(cut.to_P.mm, by.from_P.mm, by.to_P.mm)) +
         cut.radius_mm - by.radius_mm;
}

double approachedBy(double value, double goal, double dt_s, double constant_s) {
  return goal + (value - goal) * std::exp(-dt_s / constant_s);
}

}  // namespace

void SoftMarkTrail::follow(std::span<const haptics::Tick> ticks, const haptics::BurShape& head) {
  for (const haptics::Tick& tick : ticks) {
    if (tick.soft.bur_cuts != assets::SoftTissue::none)
      cut(tick, head);
    else
      last_.reset();
    if (tick.soft.touches() || !marks_.reddened.empty()) redden(tick);
  }
}

void SoftMarkTrail::cut(const haptics::Tick& tick, const haptics::BurShape& head) {
  const SoftCut here = headAt(tick, head);
  const double way_mm = last_ ? moved_mm(*last_, here) : 0.0;
  if (last_ && way_mm < kStep * here.radius_mm) return;
  // A ball leaves the way between two places; a long head lies side by side.
  const bool is_ball = here.from_P.mm == here.to_P.mm;
  if (last_ && is_ball && last_->radius_mm == here.radius_mm && way_mm < kJump * here.radius_mm)
    add({last_->from_P, here.to_P, here.radius_mm});
  else
    add(here);
  last_ = here;
}

void SoftMarkTrail::add(const SoftCut& cut) {
  std::vector<SoftCut>& cuts = marks_.cuts;
  if (std::ranges::any_of(cuts, [&](const SoftCut& by) { return uncovered_mm(cut, by) < kCovered_mm; })) return;
  // Straight on: the newest becomes longer.
  if (!cuts.empty() && last_) {
    SoftCut& newest = cuts.back();
    const bool goes_on = newest.to_P.mm == cut.from_P.mm && newest.radius_mm == cut.radius_mm;
    if (goes_on && toLine_mm(cut.from_P.mm, newest.from_P.mm, cut.to_P.mm) < kStraight_mm) {
      newest.to_P = cut.to_P;
      return;
    }
  }
  cuts.push_back(cut);
  if (cuts.size() <= render::kMostSoftCuts) return;
  std::size_t least = 0;
  double least_mm = 1e9;
  for (std::size_t n = 0; n + 1 < cuts.size(); ++n)
    for (std::size_t by = 0; by < cuts.size(); ++by)
      if (const double mm = uncovered_mm(cuts[n], cuts[by]); by != n && mm < least_mm) least = n, least_mm = mm;
  cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(least));
}

void SoftMarkTrail::redden(const haptics::Tick& tick) {
  std::vector<Reddened>& reddened = marks_.reddened;
  const glm::dvec3& place = tick.soft.place_P.mm;
  const double pressed = tick.soft.touches() ? 1.0 - std::exp(-tick.soft.depth_mm / kFullDepth_mm) : 0.0;
  const auto nearer = [&](const Reddened& a, const Reddened& b) {
    return glm::distance(a.place_P.mm, place) < glm::distance(b.place_P.mm, place);
  };
  auto here = reddened.end();
  if (pressed > kUnseen) {
    here = std::ranges::min_element(reddened, nearer);
    if (here == reddened.end() || glm::distance(here->place_P.mm, place) > kSamePlace_mm) {
      if (reddened.size() == render::kMostReddened)
        reddened.erase(std::ranges::min_element(reddened, {}, &Reddened::share));
      reddened.push_back({{place}, kRedReach_mm, 0.0});
      here = reddened.end() - 1;
    }
    here->place_P.mm += (1.0 - std::exp(-tick.dt_s / kFollows_s)) * (place - here->place_P.mm);
  }
  for (auto red = reddened.begin(); red != reddened.end(); ++red) {
    const double goal = red == here ? pressed : 0.0;
    red->share = approachedBy(red->share, goal, tick.dt_s, goal > red->share ? kReddens_s : kFades_s);
  }
  const Reddened* const kept = here == reddened.end() ? nullptr : &*here;
  std::erase_if(reddened, [&](const Reddened& red) { return &red != kept && red.share < kUnseen; });
}

}  // namespace app
