// How a scripted hand breaks a bridge with an elevator, twisted to and fro in the slot; and takes a piece of tooth out
// with forceps: down to the grip, rocking until the ligament is torn, then along the way out and beyond. Frame P is the
// device's frame D; handle and tool coincide. mm, s. Pure functions; speeds and swings are our defaults.
#pragma once

#include "app/procedure/third_molar/led_keys.h"
#include "app/procedure/third_molar/operation_planner.h"
#include "haptics/device/simulated/led_hand.h"

namespace app {

/// Out of the mouth to `outside_P_mm`, turned there, and in again: soft tissue is met by none of it.
haptics::LedPath throughOutside(const HandPose& from, const HandPose& to, const glm::dvec3& outside_P_mm);

/// One after the other.
haptics::LedPath joined(const haptics::LedPath& first, const haptics::LedPath& second);

/// From `from` to over the slot, down, twisted, and up again.
haptics::LedPath twistInSlot(const HandPose& from, const glm::dvec3& outside_P_mm, const SplitStep& step);

/// From `from` to over the piece, down, closed, and rocked with growing swings for `kRocks_s`.
haptics::LedPath gripAndRock(const HandPose& from, const glm::dvec3& outside_P_mm, const DeliveryStep& step,
                             const glm::dquat& R_PT);
inline constexpr double kRocks_s = 12.0;

/// Closed, along the way out from where hand and piece are now, then out of the mouth to `laid_P_mm`, and open there:
/// left over the socket, a piece would be in the way of the next instrument's shank.
haptics::LedPath takeOut(const HandPose& hand, const haptics::PiecePose& piece_X_PQ, const DeliveryStep& step,
                         const glm::dvec3& outside_P_mm, const glm::dvec3& laid_P_mm);

}  // namespace app
