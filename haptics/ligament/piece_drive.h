// What moves a piece in its socket: a constant wrench, and a spring towards a pose, as an instrument in the hand or a
// measurement applies them. The spring's torque is 2 K sin(angle / 2) along the axis of the turn that remains, so that
// it has an energy without an angle; its force and torque end at bounds, as a hand does. Frames P and Q; mm, N, N mm.
// Servo thread; plain values.
#pragma once

#include <limits>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/ligament/six.h"
#include "haptics/wrench.h"

namespace haptics {

using PiecePose = calibration::Pose<calibration::Patient, calibration::Piece>;

/// A stiffness of zero leaves free.
struct PieceSpring {
  PiecePose target_X_PQ;
  calibration::Point<calibration::Piece> grip_Q;  ///< the point that is held
  double stiffness_N_per_mm = 0.0;
  double stiffness_Nmm_per_rad = 0.0;
  double most_force_N = std::numeric_limits<double>::infinity();
  double most_torque_Nmm = std::numeric_limits<double>::infinity();
};

struct PieceDrive {
  calibration::Vector<calibration::Patient> force_N;
  calibration::Vector<calibration::Patient> torque_Nmm;  ///< about load_at_P
  calibration::Point<calibration::Patient> load_at_P;    ///< the force acts along a line through it
  PieceSpring spring;
};

/// Energy that a drive adds at a pose, its slope and curvature (positive or zero), about the piece's centre.
struct Balance {
  double energy_Nmm = 0.0;
  Six gradient{};
  SymmetricSix hessian;

  void addForce(const glm::dvec3& arm_mm, const glm::dvec3& slope_N, const glm::dmat3& stiffness_N_per_mm) noexcept;
};

/// A pull along a way to its target, at most `most_N`, on a point at an arm. Returns the force on it.
glm::dvec3 addPull(double stiffness_N_per_mm, double most_N, const glm::dvec3& arm_mm, const glm::dvec3& way_mm,
                   Balance& balance) noexcept;

/// Force and torque of the spring on the piece; torque about the grip.
Wrench<calibration::Patient> addSpring(const PieceSpring& spring, const PiecePose& X_PQ, const glm::dvec3& centre_Q_mm,
                                       Balance& balance) noexcept;

/// Drag of a way and a turn since `start_X_PQ`, and stiffness of both.
void addDrag(const PiecePose& start_X_PQ, const PiecePose& X_PQ, const glm::dvec3& centre_Q_mm, double N_per_mm,
             double lever_mm, Balance& balance) noexcept;
/// The same of a tool, about a point of it.
void addDrag(const calibration::Pose<calibration::Patient, calibration::Tool>& start_X_PT,
             const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const glm::dvec3& centre_T_mm,
             double N_per_mm, double lever_mm, Balance& balance) noexcept;

/// Finite, no stiffness or bound below zero, the target's rotation of length one.
bool isUsable(const PieceDrive& drive) noexcept;

}  // namespace haptics
