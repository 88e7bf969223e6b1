#include "app/case/patient_placement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "assets/synthetic/face.h"

namespace app {

using calibration::Patient;
using calibration::Point;
using calibration::Pose;
using calibration::Vector;
using calibration::World;

namespace {

/// Elevation of the line of sight over the horizontal, with the head bent down to the mouth.
constexpr double kEyeElevation_rad = calibration::radFromDegrees(60.0);

double clockHour(PatientPosition position) {
  return position == PatientPosition::right ? 10.0 : position == PatientPosition::left ? 2.0 : 12.0;
}

/// From the mouth to the eye, in the axes of a straight lying head: x to its left, y to its crown, z to the ceiling.
glm::dvec3 lyingEyeDirection(PatientPosition position) {
  const double turn_rad = calibration::radFromDegrees(30.0 * (clockHour(position) - 12.0));
  const double level = std::cos(kEyeElevation_rad);
  return {level * std::sin(turn_rad), level * std::cos(turn_rad), std::sin(kEyeElevation_rad)};
}

/// The line of sight through the open mouth, in the axes of the head.
glm::dvec3 bestEyeDirection_F(int tooth_fdi) {
  return (assets::kFaceAxes_PF.inverse() * Vector<Patient>{assets::surgeonEyeDirection(tooth_fdi)}).xyz;
}

}  // namespace

Pose<World, Patient> placePatient(const Point<Patient>& site_P, const Vector<Patient>& eye_direction_P,
                                  const Vector<Patient>& up_P) {
  // The axes of W as seen from P are the rows of R_WP.
  const glm::dvec3 z = glm::normalize(eye_direction_P.xyz);
  const glm::dvec3 across = glm::cross(up_P.xyz, z);
  assert(glm::length(across) > 1e-6 && "up must not be along the line of sight");
  const glm::dvec3 x = glm::normalize(across), y = glm::cross(z, x);
  const glm::dquat R_WP = glm::quat_cast(glm::transpose(glm::dmat3(x, y, z)));
  return {R_WP, -(R_WP * site_P.mm)};
}

PatientPosition patientPositionNamed(std::string_view name) {
  const auto found = std::ranges::find(kPatientPositions, name);
  assert(found != kPatientPositions.end());
  return static_cast<PatientPosition>(found - kPatientPositions.begin());
}

HeadPose headPose(PatientPosition position, int tooth_fdi) {
  if (position == PatientPosition::seated) return {};
  const glm::dvec3 eye = lyingEyeDirection(position), best = bestEyeDirection_F(tooth_fdi);
  // A turn about the long axis y gives the lateral component, a tilt about x the other two.
  const double across = std::hypot(eye.x, eye.z);
  const double turn_rad = std::atan2(eye.x, eye.z) - std::asin(std::clamp(best.x / across, -1.0, 1.0));
  const double turned_rad = std::clamp(turn_rad, -kMaxHeadTurn_rad, kMaxHeadTurn_rad);
  const double z = across * std::cos(std::atan2(eye.x, eye.z) - turned_rad);
  const double tilt_rad = std::atan2(eye.y, z) - std::atan2(best.y, best.z);
  return {turned_rad, std::clamp(tilt_rad, -kMaxHeadTilt_rad, kMaxHeadTilt_rad)};
}

namespace {

/// Of a lying patient.
glm::dquat headFromRoom(PatientPosition position, int tooth_fdi) {
  const HeadPose head = headPose(position, tooth_fdi);
  return glm::angleAxis(head.tilt_rad, glm::dvec3(1.0, 0.0, 0.0)) *
         glm::angleAxis(-head.turn_rad, glm::dvec3(0.0, 1.0, 0.0));
}

Vector<calibration::Face> upInRoom(PatientPosition position, int tooth_fdi) {
  if (position == PatientPosition::seated) return {{0.0, 1.0, 0.0}};
  return {headFromRoom(position, tooth_fdi) * glm::dvec3(0.0, 0.0, 1.0)};
}

}  // namespace

Pose<World, Patient> placePatientAtSite(const assets::Patient& patient, const assets::FacePose& X_PF,
                                        PatientPosition position) {
  Vector<calibration::Face> eye_F{bestEyeDirection_F(patient.operatedTooth())};
  if (position != PatientPosition::seated)
    eye_F = {headFromRoom(position, patient.operatedTooth()) * lyingEyeDirection(position)};
  return placePatient({patient.focus_P_mm()}, X_PF * eye_F, X_PF * upInRoom(position, patient.operatedTooth()));
}

Vector<Patient> downInRoom(const assets::Patient& patient, const assets::FacePose& X_PF, PatientPosition position) {
  return X_PF * Vector<calibration::Face>{-upInRoom(position, patient.operatedTooth()).xyz};
}

bool hasNoPatientPose(const calibration::Rig& rig) {
  return rig.X_WP.translation_mm == glm::dvec3(0.0) && rig.X_WP.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0);
}

}  // namespace app
