#include "haptics/servo/soft_hold.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using assets::SoftTissue;
using assets::SoftTissueField;
using calibration::Patient;
using calibration::Vector;

constexpr int kMaxSteps = 4, kSweeps = 3;
constexpr double kLongestStep_mm = 1.0;  // of the tool's origin or of its far end
constexpr double kFreeStep_mm = 2.0;     // thinner than any shaft with the thinnest tissue around it
constexpr double kSettled_mm = 1e-5;
constexpr double kEnd_mm = 110.0;         // of the handpiece
constexpr double kContactSkin_mm = 0.02;  // this near counts as touching what holds it
constexpr double kInTissue_mm = 0.1;      // this deep counts as being in it, held or not
constexpr double kMaxTurn_rad = 0.6;

/// The rotation vector of a unit quaternion.
glm::dvec3 rotationVector_rad(const glm::dquat& q) noexcept {
  const glm::dvec3 half = (q.w < 0.0 ? -1.0 : 1.0) * glm::dvec3(q.x, q.y, q.z);
  const double sine = glm::length(half);
  if (!(sine > 1e-12)) return {};
  return (2.0 * std::atan2(sine, std::abs(q.w)) / sine) * half;
}

glm::dquat rotationBy(const glm::dvec3& vector_rad) noexcept {
  const double angle = glm::length(vector_rad);
  if (!(angle > 1e-12)) return {1.0, 0.0, 0.0, 0.0};
  const glm::dvec3 imaginary = std::sin(0.5 * angle) / angle * vector_rad;
  return {std::cos(0.5 * angle), imaginary.x, imaginary.y, imaginary.z};
}

/// From one attitude to the other, in P.
glm::dvec3 turnBetween_rad(const glm::dquat& from, const glm::dquat& to) noexcept {
  return rotationVector_rad(to * glm::conjugate(from));
}

}  // namespace

void SoftHold::place(const SoftTissueField& field, const Tool& tool, const ToolPose& X_PT) noexcept {
  tool_ = tool;
  outline_ = outlineOf(tool);
  held_ = X_PT;
  placed_ = true;
  account_.open();
  last_X_PT_ = X_PT;
  last_force_N_ = last_torque_Nmm_ = {};
  for (std::size_t n = 0; n < outline_.count; ++n)
    buried_mm_[n] = std::max(0.0, outline_.balls[n].radius_mm - field.at(centre_P(held_, n)).distance_mm);
}

bool SoftHold::isFree(const SoftTissueField& field, const ToolPose& X_PT, bool turning) const noexcept {
  for (std::size_t n = 0; n < outline_.count; ++n) {
    const glm::dvec3 centre = centre_P(X_PT, n);
    if (field.at(centre).distance_mm < outline_.balls[n].radius_mm + kContactSkin_mm &&
        !givesWay(field.tissueAt(centre), turning && n < outline_.head_count))
      return false;
  }
  return true;
}

/// A step of bounded length; ends exactly at the hand if that is near.
void SoftHold::moveTowards(const ToolPose& X_PT) noexcept {
  const glm::dvec3 shift = X_PT.translation_mm - held_.translation_mm;
  const glm::dvec3 turn = turnBetween_rad(held_.rotation, X_PT.rotation);
  const double length_mm = glm::length(shift) + kEnd_mm * glm::length(turn);
  if (length_mm <= kLongestStep_mm) {
    held_ = X_PT;
    return;
  }
  const double part = kLongestStep_mm / length_mm;
  held_.translation_mm += part * shift;
  held_.rotation = glm::normalize(rotationBy(part * turn) * held_.rotation);
}

/// Shifts and tilts the held pose until no ball is deeper than it may be. Returns the ball pushed most.
SoftHold::Contact SoftHold::pushOut(const SoftTissueField& field, bool turning) noexcept {
  constexpr double kInverseLever2 = 1.0 / (SoftHoldLaw::kLever_mm * SoftHoldLaw::kLever_mm);
  std::array<double, InstrumentOutline::kMaxBalls> pushed_mm{};
  Contact most;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool pushes = false;
    for (std::size_t n = turning ? outline_.head_count : 0; n < outline_.count; ++n) {
      const glm::dvec3 arm = held_.rotation * glm::dvec3(0.0, 0.0, outline_.balls[n].z_mm);
      const SoftTissueField::Sample at = field.at(held_.translation_mm + arm);
      const double missing_mm = outline_.balls[n].radius_mm - buried_mm_[n] - at.distance_mm;
      const double slope = glm::length(at.gradient_P);
      if (missing_mm <= 0.0 || slope < 0.2 || givesWay(field.tissueAt(held_.translation_mm + arm), false)) continue;
      const glm::dvec3 normal = at.gradient_P / slope, lever = glm::cross(arm, normal);
      const double push_mm = missing_mm / (1.0 + kInverseLever2 * glm::dot(lever, lever));
      held_.translation_mm += push_mm * normal;
      held_.rotation = glm::normalize(rotationBy(kInverseLever2 * push_mm * lever) * held_.rotation);
      pushed_mm[n] += push_mm;
      pushes = true;
      if (pushed_mm[n] >= most.push_mm) most = {n, pushed_mm[n], normal};
    }
    if (!pushes) break;
  }
  return most;
}

SoftTouch SoftHold::touched(const SoftTissueField& field, const Contact& most, bool turning) noexcept {
  SoftTouch touch;
  double deepest_mm = 0.0;
  std::size_t deepest = most.ball;
  for (std::size_t n = 0; n < outline_.count; ++n) {
    const glm::dvec3 centre = centre_P(held_, n);
    const double inside_mm = outline_.balls[n].radius_mm - field.at(centre).distance_mm;
    const bool is_cut = turning && n < outline_.head_count;
    // What has left the tissue is held again.
    buried_mm_[n] = is_cut ? std::max(0.0, inside_mm) : std::clamp(inside_mm, 0.0, buried_mm_[n]);
    const bool is_held =
        most.push_mm > 0.0 && inside_mm > buried_mm_[n] - kContactSkin_mm && inside_mm > -kContactSkin_mm;
    if (!(is_held && !is_cut) && inside_mm < kInTissue_mm) continue;
    const SoftTissue tissue = field.tissueAt(centre);
    if (givesWay(tissue, is_cut)) continue;
    touch.tissues = static_cast<std::uint8_t>(touch.tissues | assets::bitOf(tissue));
    if (is_cut && touch.bur_cuts == SoftTissue::none) touch.bur_cuts = tissue;
    if (inside_mm > deepest_mm) deepest_mm = inside_mm, deepest = n;
  }
  if (!touch.touches()) return touch;
  const std::size_t ball = most.push_mm > 0.0 ? most.ball : deepest;
  const glm::dvec3 centre = centre_P(held_, ball);
  const SoftTissueField::Sample at = field.at(centre);
  touch.tissue = field.tissueAt(centre);
  touch.place_P.mm = centre - at.distance_mm * at.gradient_P;
  touch.depth_mm = most.push_mm > 0.0 ? 0.0 : deepest_mm;
  return touch;
}

SoftHold::State SoftHold::update(const SoftTissueField* field, const Tool& tool, const ToolPose& X_PT,
                                 const Vector<Patient>& velocity_P_mm_per_s, bool turning,
                                 std::uint8_t passable) noexcept {
  passable_ = passable;
  if (field == nullptr || field->isEmpty()) return {X_PT, {}, 0.0};
  if (!placed_ || !(tool == tool_)) place(*field, tool, X_PT);

  // Outside of all tissue, and not held behind a thin one: the hand's pose.
  const glm::dvec3 shift = X_PT.translation_mm - held_.translation_mm;
  const glm::dvec3 turn = turnBetween_rad(held_.rotation, X_PT.rotation);
  const bool is_near = glm::length(shift) + kEnd_mm * glm::length(turn) < kFreeStep_mm;
  Contact most;
  if (is_near && isFree(*field, X_PT, turning)) {
    held_ = X_PT;
    buried_mm_.fill(0.0);
    settle(X_PT, {}, 0.0);
    account_.open();
    return {X_PT, {}, 0.0};
  }
  for (int step = 0; step < kMaxSteps; ++step) {
    const ToolPose before = held_;
    moveTowards(X_PT);
    most = pushOut(*field, turning);
    const double moved_mm = glm::length(held_.translation_mm - before.translation_mm) +
                            kEnd_mm * glm::length(turnBetween_rad(before.rotation, held_.rotation));
    if (moved_mm < kSettled_mm || (held_.translation_mm == X_PT.translation_mm && held_.rotation == X_PT.rotation))
      break;
  }
  const glm::dvec3 tilt = turnBetween_rad(X_PT.rotation, held_.rotation);
  if (const double angle = glm::length(tilt); angle > kMaxTurn_rad)
    held_.rotation = glm::normalize(rotationBy(kMaxTurn_rad / angle * tilt) * X_PT.rotation);

  State state{held_, touched(*field, most, turning), 0.0};
  push(state, X_PT, velocity_P_mm_per_s, most);
  return state;
}

/// What is felt of the held pose.
void SoftHold::push(State& state, const ToolPose& X_PT, const Vector<Patient>& velocity_P_mm_per_s,
                    const Contact& most) noexcept {
  const glm::dvec3 u = held_.translation_mm - X_PT.translation_mm;
  const glm::dvec3 t = turnBetween_rad(X_PT.rotation, held_.rotation);
  constexpr double kL = SoftHoldLaw::kLever_mm, kMax_N = SoftHoldLaw::kMaxForce_N;
  const double distance_mm = std::sqrt(glm::dot(u, u) + kL * kL * glm::dot(t, t));
  if (!(distance_mm > 1e-9)) return settle(X_PT, state.touch, 0.0);

  // The hand has pushed the ball in as far as the tissue has moved it out.
  if (most.push_mm > 0.0) {
    const glm::dvec3 arm = centre_P(held_, most.ball) - held_.translation_mm;
    state.touch.depth_mm = std::max(0.0, glm::dot(most.normal_P, u + glm::cross(t, arm)));
  }
  const glm::dvec3 force_P = u / distance_mm, torque_P_mm = kL * kL / distance_mm * t;  // of 1 N
  const double along_mm = glm::dot(force_P, X_PT.translation_mm - last_X_PT_.translation_mm) +
                          glm::dot(torque_P_mm, turnBetween_rad(last_X_PT_.rotation, X_PT.rotation));
  const double spring_N = account_.force_N(account_.covered_mm(distance_mm, lastWork_Nmm(X_PT), along_mm));
  const double leaving_mm_per_s = glm::dot(velocity_P_mm_per_s.xyz, u) / distance_mm;
  const double full = std::min(1.0, distance_mm / 0.5);  // the damping begins without a step
  const double force_N = std::clamp(spring_N - full * SoftHoldLaw::kDamping_Ns_per_mm * leaving_mm_per_s, 0.0, kMax_N);
  state.touch.force_P_N.xyz = force_N * force_P;
  state.touch.torque_P_Nmm.xyz = force_N * torque_P_mm;
  state.touch.turn_P = held_.rotation * glm::conjugate(X_PT.rotation);
  state.max_stored_Nmm = std::min(0.5 * SoftHoldLaw::kStiffness_N_per_mm * distance_mm, kMax_N) * distance_mm;
  settle(X_PT, state.touch, distance_mm);
}

/// On the hand, by the wrench of the last tick on the way to this pose.
double SoftHold::lastWork_Nmm(const ToolPose& X_PT) const noexcept {
  return glm::dot(last_force_N_.xyz, X_PT.translation_mm - last_X_PT_.translation_mm) +
         glm::dot(last_torque_Nmm_.xyz, turnBetween_rad(last_X_PT_.rotation, X_PT.rotation));
}

/// Books the work of this tick by the midpoint rule.
void SoftHold::settle(const ToolPose& X_PT, const SoftTouch& touch, double deflection_mm) noexcept {
  double work_Nmm = lastWork_Nmm(X_PT);
  last_force_N_ = touch.force_P_N, last_torque_Nmm_ = touch.torque_P_Nmm;
  work_Nmm += lastWork_Nmm(X_PT);
  account_.close(0.5 * work_Nmm, deflection_mm);
  last_X_PT_ = X_PT;
}

}  // namespace haptics
