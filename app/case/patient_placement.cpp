#include "app/case/patient_placement.h"

#include <cassert>

#include "assets/synthetic/face.h"

namespace app {

using calibration::Patient;
using calibration::Point;
using calibration::Pose;
using calibration::Vector;
using calibration::World;

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

Pose<World, Patient> placePatientAtSite(const assets::Patient& patient, const assets::FacePose& X_PF) {
  // LPS axes of the head to F, then with the head to P.
  const Vector<Patient> eye_P{assets::surgeonEyeDirection(patient.operatedTooth())};
  const Vector<calibration::Face> eye_F = assets::kFaceAxes_PF.inverse() * eye_P, up_F{{0.0, 1.0, 0.0}};
  return placePatient({patient.focus_P_mm()}, X_PF * eye_F, X_PF * up_F);
}

bool hasNoPatientPose(const calibration::Rig& rig) {
  return rig.X_WP.translation_mm == glm::dvec3(0.0) && rig.X_WP.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0);
}

}  // namespace app
