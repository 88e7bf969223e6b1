// How a hand drives an elevator's blade: springs from where the hand has the tool to where the blade is. The place of
// T's origin, the twist about the blade's z axis, and the other two angles each have a stiffness and a bound; turns as
// 2 K sin(angle / 2), see piece_drive.h. Twist is the turn about z that is left of the whole turn when the shortest
// tilt is taken off; it counts within half a turn. mm, N, N mm of the model. Servo thread. Reference/extraction 5.2.
#pragma once

#include "haptics/ligament/piece_drive.h"

namespace haptics {

using ToolPose = calibration::Pose<calibration::Patient, calibration::Tool>;

struct ElevatorHand {
  ToolPose X_PT;                      ///< where the hand has the tool
  double stiffness_N_per_mm = 25.0;   ///< as of forceps: 0.5 N/mm are felt at a scale of 50
  double most_N = 165.0;              ///< 3.3 N are felt
  double twist_Nmm_per_rad = 2900.0;  ///< 2 N m for 40 degrees between hand and blade. Our default
  double most_twist_Nmm = 2000.0;     ///< what a hand gives on a handle of 12 to 16 mm, reference/extraction 1.2
  double tilt_Nmm_per_rad = 8000.0;
  double most_tilt_Nmm = 3000.0;  ///< as of forceps. Our default
};

struct HandPull {
  Wrench<calibration::Patient> on_blade{};  ///< about T's origin
  double twist_Nmm = 0.0;                   ///< about the blade's z
  double stored_Nmm = 0.0;
};

/// On the blade at X_PT, whose six coordinates are about `middle_T_mm`.
HandPull addHand(const ElevatorHand& hand, const ToolPose& X_PT, const glm::dvec3& middle_T_mm,
                 Balance& balance) noexcept;

/// Finite, no stiffness or bound below zero, a rotation of length one.
bool isUsable(const ElevatorHand& hand) noexcept;

}  // namespace haptics
