#include "app/session/measures/near_work.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/session/measures/clearance_measures.h"

namespace app {
namespace {

constexpr double kMoved_mm = 0.02;        ///< of a clearance asked for, at most
constexpr double kBetweenLooks_s = 0.01;  ///< of the direction of an approach

constexpr std::size_t kPerStructure = 5;
constexpr auto kNearWork = std::to_array<MeasureName>({
    {"S3.canal_max", "largest force nearer than 2 mm to the mandibular canal", "N"},
    {"S3.canal_p95", "95 % of the force nearer than 2 mm to the mandibular canal", "N"},
    {"S3.canal_impulse", "impulse nearer than 2 mm to the mandibular canal", "N s"},
    {"S4.canal", "risk integral of the mandibular canal", "N s"},
    {"S5.canal", "fastest approach to the mandibular canal nearer than 4 mm", "mm/s"},
    {"S3.lingual_max", "largest force nearer than 2 mm to the outer lingual surface", "N"},
    {"S3.lingual_p95", "95 % of the force nearer than 2 mm to the outer lingual surface", "N"},
    {"S3.lingual_impulse", "impulse nearer than 2 mm to the outer lingual surface", "N s"},
    {"S4.lingual", "risk integral of the outer lingual surface", "N s"},
    {"S5.lingual", "fastest approach to the outer lingual surface nearer than 4 mm", "mm/s"},
    {"S3.second_molar_max", "largest force nearer than 2 mm to the second molar", "N"},
    {"S3.second_molar_p95", "95 % of the force nearer than 2 mm to the second molar", "N"},
    {"S3.second_molar_impulse", "impulse nearer than 2 mm to the second molar", "N s"},
    {"S4.second_molar", "risk integral of the second molar", "N s"},
    {"S5.second_molar", "fastest approach to the second molar nearer than 4 mm", "mm/s"},
});

/// To the structure, unit; zero where it has no direction.
glm::dvec3 directionTo_P(const assets::StructureDistance& structure, const glm::dvec3& p_P_mm) {
  // Over half a millimetre to either side: the structure's direction, not a voxel's.
  constexpr double kReach_mm = 0.5;
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = kReach_mm;
    gradient[axis] = structure.at_mm(p_P_mm + step) - structure.at_mm(p_P_mm - step);
  }
  const double length = glm::length(gradient);
  return length > 0.2 * kReach_mm ? -gradient / length : glm::dvec3(0.0);
}

}  // namespace

void NearWork::look(One& one, const assets::StructureDistance& structure, const haptics::Tick& tick,
                    const haptics::Tool& tool) const {
  // Where it cannot have come into the band its distance is of no interest.
  const bool can_be_near = !one.is_asked || one.asked_mm - one.moved_mm < kBand_mm;
  if (!can_be_near || (one.is_asked && one.moved_mm < kMoved_mm)) return;
  one.asked_mm = haptics::clearance_mm(structure, tool, heldPose(tick));
  one.moved_mm = 0.0, one.is_asked = true;
}

void NearWork::approach(One& one, const assets::StructureDistance& structure, const haptics::Tick& tick) const {
  one.since_look_s += tick.dt_s;
  if (one.since_look_s >= kBetweenLooks_s) {
    one.since_look_s = 0.0;
    one.towards_P = directionTo_P(structure, tick.proxy_P.mm);
  }
  const double speed = std::max(0.0, glm::dot(one.towards_P, tick.hand.velocity_P_mm_per_s.xyz));
  if (!one.approach_mm_per_s || speed > *one.approach_mm_per_s)
    one.approach_mm_per_s = speed, one.approach_s = tick.t_s;
}

void NearWork::add(const haptics::Tick& tick, const haptics::Tool& tool) {
  if (!tool.turns() || has(tick.faults, haptics::Fault::bad_pose)) return;
  const auto X_PT = heldPose(tick);
  if (last_ && tool == tool_) {
    const glm::dquat turn = X_PT.rotation * glm::conjugate(last_->rotation);
    const double reach_mm =
        std::max(haptics::halfHeight_mm(tool.head), tool.shaft.length_mm) + tool.head.radius_mm + tool.shaft.radius_mm;
    const double moved_mm = glm::distance(X_PT.translation_mm, last_->translation_mm) +
                            2.0 * glm::length(glm::dvec3(turn.x, turn.y, turn.z)) * reach_mm;
    for (One& one : ones_) one.moved_mm += moved_mm;
  } else {
    tool_ = tool;
    for (One& one : ones_) one.is_asked = false;
  }
  last_ = X_PT;
  turned_ = turned_ || tick.drilling;
  const double force_N = glm::length(tick.law_force_P_N.xyz);
  if (!tick.drilling && !(force_N > 0.0)) return;
  for (std::size_t n = 0; n < kStructures; ++n) {
    const assets::StructureDistance& structure = structures_.distance[n];
    if (structure.isEmpty()) continue;
    One& one = ones_[n];
    look(one, structure, tick, tool);
    const double mm = one.asked_mm - (one.asked_mm - one.moved_mm >= kBand_mm ? one.moved_mm : 0.0);
    if (n == 0 && tick.overlap_mm3 > 0.0)
      envelope_.add(ContactEnvelope::bandOf(mm), force_N, glm::length(tick.hand.velocity_P_mm_per_s.xyz), tick.dt_s);
    if (tick.drilling && mm < kBand_mm) approach(one, structure, tick);
    if (!(mm < kNear_mm)) continue;
    one.near_s += tick.dt_s;
    one.impulse_Ns += tick.dt_s * force_N;
    if (tick.drilling) one.risk_Ns += tick.dt_s * (1.0 - mm / kNear_mm) * force_N;
    if (force_N > one.most_N) one.most_N = force_N, one.most_s = tick.t_s;
    if (one.force_s.empty()) one.force_s.resize(kForceClasses);
    const auto at = static_cast<std::size_t>(std::clamp(force_N / kForceClass_N, 0.0, kForceClasses - 1.0));
    one.force_s[at] += tick.dt_s;
  }
}

std::vector<MeasureValue> NearWork::values() const {
  std::vector<MeasureValue> values = untold(kNearWork, "");
  for (std::size_t n = 0; n < kStructures; ++n) {
    const std::span<MeasureValue> own(&values[kPerStructure * n], kPerStructure);
    const One& one = ones_[n];
    const bool is_known = !structures_.distance[n].isEmpty();
    if (!is_known || !turned_) {
      for (MeasureValue& value : own)
        value.why =
            is_known ? "the drill was not on" : "the case has no such structure, or was recorded before it was kept";
      continue;
    }
    double until_s = 0.0, p95_N = 0.0;
    for (std::size_t at = 0; at < one.force_s.size() && until_s < 0.95 * one.near_s; ++at) {
      until_s += one.force_s[at];
      p95_N = kForceClass_N * (static_cast<double>(at) + 0.5);
    }
    own[0].value = one.most_N, own[0].t_s = one.most_s;
    own[1].value = std::min(p95_N, one.most_N);
    own[2].value = one.impulse_Ns;
    own[3].value = one.risk_Ns;
    own[4].value = one.approach_mm_per_s.value_or(0.0), own[4].t_s = one.approach_s;
    for (MeasureValue& value : own) value.conditions = "force of the model, before limits and scale";
    own[4].conditions = "the head's centre, drill on";
  }
  return values;
}

std::vector<MeasureValue> noEnvelope() {
  constexpr auto kOfEnvelope = std::to_array<MeasureName>({
      {"S6.force", "share of contact with more force than 95 % of a reference at that distance to the canal", ""},
      {"S6.speed", "share of contact faster than 95 % of a reference at that distance to the canal", ""},
  });
  return untold(kOfEnvelope, "it needs a reference set, see molar reference");
}

std::vector<MeasureValue> noNearWork(std::string_view why) { return untold(kNearWork, why); }

}  // namespace app
