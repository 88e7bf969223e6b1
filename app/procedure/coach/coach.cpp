#include "app/procedure/coach/coach.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace app {

Coach::Coach(CoachRules rules)
    : rules_(std::move(rules)),
      strokes_([this](const Stroke& stroke) {
        if (stroke.radius_mm > 0.0) deepest_ = std::max(deepest_, stroke.depth_mm / stroke.radius_mm);
      }),
      seen_s_(rules_.rules.size(), 0.0),
      said_at_s_(rules_.rules.size()),
      is_due_(rules_.rules.size(), 0) {}

void Coach::addWay(const WorkSample& sample) {
  if (!sample.drills() || sample.normal_P == glm::dvec3(0.0)) return;
  if (part_s_[part_] >= kWindow_s / kParts) {
    part_ = (part_ + 1) % kParts;
    into_mm_[part_] = along_mm_[part_] = part_s_[part_] = 0.0;
  }
  const double out = glm::dot(sample.velocity_P_mm_per_s, sample.normal_P);
  into_mm_[part_] += sample.dt_s * std::max(0.0, -out);
  along_mm_[part_] += sample.dt_s * glm::length(sample.velocity_P_mm_per_s - out * sample.normal_P);
  part_s_[part_] += sample.dt_s;
}

bool Coach::isSeen(const CoachRule& rule, const WorkSample& sample) const {
  switch (rule.looks_for) {
    case CoachSign::force:
      return sample.drills() && glm::length(sample.force_P_N) > rule.most;
    case CoachSign::plunging: {
      const double into = std::accumulate(into_mm_.begin(), into_mm_.end(), 0.0);
      return sample.drills() && into > kLeastWay_mm &&
             into > rule.most * std::accumulate(along_mm_.begin(), along_mm_.end(), 0.0);
    }
    case CoachSign::deep_stroke:
      return deepest_ > rule.most;
    case CoachSign::dry:
      return sample.drills() && !sample.irrigated;
    case CoachSign::lingering: {
      const double out = glm::dot(sample.velocity_P_mm_per_s, sample.normal_P);
      return sample.drills() && glm::length(sample.velocity_P_mm_per_s - out * sample.normal_P) < kMoves_mm_per_s;
    }
    case CoachSign::near_structure:
      return sample.drills() && context_.nearest_mm && *context_.nearest_mm < rule.within_mm &&
             glm::length(sample.force_P_N) > rule.most;
    case CoachSign::wrong_step:
      return context_.is_other_instrument;
    case CoachSign::out_of_sight:
      return sample.drills() && context_.is_out_of_sight;
  }
  return false;
}

void Coach::add(const WorkSample& sample, const CoachContext& context) {
  if (!sample.valid) {  // a break of what is seen, and the end of a stroke
    strokes_.add(sample);
    std::ranges::fill(seen_s_, 0.0);
    return;
  }
  context_ = context;
  now_s_ = sample.t_s + sample.dt_s;
  deepest_ = 0.0;
  strokes_.add(sample);
  addWay(sample);
  for (std::size_t n = 0; n < rules_.rules.size(); ++n) {
    const bool is_seen = isSeen(rules_.rules[n], sample);
    seen_s_[n] = is_seen ? seen_s_[n] + sample.dt_s : 0.0;
    if (is_seen && seen_s_[n] >= rules_.rules[n].for_s) is_due_[n] = 1;
  }
}

std::optional<std::string> Coach::take() {
  std::optional<std::string> says;
  const bool may_speak = !last_s_ || now_s_ - *last_s_ >= rules_.pause_s;
  for (std::size_t n = 0; n < rules_.rules.size(); ++n) {
    const bool is_due = std::exchange(is_due_[n], 0) != 0;
    if (!is_due || says || !may_speak) continue;
    if (said_at_s_[n] && now_s_ - *said_at_s_[n] < rules_.again_s) continue;
    says = rules_.rules[n].says;
    said_at_s_[n] = last_s_ = now_s_;
    seen_s_[n] = 0.0;
  }
  return says;
}

}  // namespace app
