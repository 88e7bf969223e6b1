#include "app/case/patient_placement.h"

#include <gtest/gtest.h>

#include "assets/synthetic/face.h"

namespace app {
namespace {

TEST(PatientPlacement, PlacesTheSiteOnTheScreenFacingTheSurgeon) {
  const calibration::Point<calibration::Patient> site{{-27, 38, -5}};
  const calibration::Vector<calibration::Patient> eye{glm::normalize(glm::dvec3(-0.3, -0.8, 0.4))}, up{{0, 0, 1}};
  const auto X_WP = placePatient(site, eye, up);
  EXPECT_LT(glm::length((X_WP * site).mm), 1e-12);
  EXPECT_LT(glm::distance((X_WP * eye).xyz, glm::dvec3(0, 0, 1)), 1e-12);
  EXPECT_NEAR((X_WP * up).xyz.x, 0.0, 1e-12) << "the patient is upright";
  EXPECT_GT((X_WP * up).xyz.y, 0.0);
}

TEST(PatientPlacement, KeepsScaleAndHandedness) {
  const auto X_WP = placePatient({{1, 2, 3}}, {{0.2, -0.9, 0.1}}, {{0, 0, 1}});
  EXPECT_NEAR(glm::determinant(glm::dmat3(X_WP.matrix())), 1.0, 1e-12);
}

/// A patient that is only a site.
assets::Patient patientWith(int fdi) {
  assets::Patient patient;
  patient.site = assets::OperativeSite{};
  patient.site->fdi = fdi;
  return patient;
}

/// An axis of the head in W.
glm::dvec3 headAxis_W(int fdi, PatientPosition position, const glm::dvec3& axis_F) {
  const auto X_WP = placePatientAtSite(patientWith(fdi), assets::kFaceAxes_PF, position);
  return (X_WP * (assets::kFaceAxes_PF * calibration::Vector<calibration::Face>{axis_F})).xyz;
}

constexpr glm::dvec3 kLeft{1, 0, 0}, kCrown{0, 1, 0}, kForward{0, 0, 1};

TEST(PatientPosition, TurnsTheHeadWithinHumanLimitsToTheBestLineOfSight) {
  for (const int fdi : {38, 48})
    for (const auto position : {PatientPosition::right, PatientPosition::left, PatientPosition::behind}) {
      const HeadPose head = headPose(position, fdi);
      EXPECT_LE(std::abs(head.turn_rad), kMaxHeadTurn_rad);
      EXPECT_LE(std::abs(head.tilt_rad), kMaxHeadTilt_rad);
      const auto X_WP = placePatientAtSite(patientWith(fdi), assets::kFaceAxes_PF, position);
      const glm::dvec3 to_eye_W =
          (X_WP * calibration::Vector<calibration::Patient>{assets::surgeonEyeDirection(fdi)}).xyz;
      EXPECT_GT(to_eye_W.z, std::cos(calibration::radFromDegrees(0.1))) << fdi << " " << static_cast<int>(position);
    }
  EXPECT_LT(headPose(PatientPosition::right, 48).turn_rad, 0.0) << "towards the surgeon at the right";
  EXPECT_GT(headPose(PatientPosition::left, 38).turn_rad, 0.0);
}

TEST(PatientPosition, ThePictureIsAsTheSurgeonStandsThere) {
  for (const int fdi : {38, 48}) {
    EXPECT_GT(headAxis_W(fdi, PatientPosition::seated, kCrown).y, 0.5) << "upright";
    EXPECT_LT(headAxis_W(fdi, PatientPosition::behind, kCrown).y, -0.5) << "the crown is near the surgeon";
    EXPECT_GT(headAxis_W(fdi, PatientPosition::right, kLeft).y, 0.4) << "the left side is away";
    EXPECT_LT(headAxis_W(fdi, PatientPosition::left, kLeft).y, -0.4);
    for (const std::string_view name : kPatientPositions)
      EXPECT_GT(headAxis_W(fdi, patientPositionNamed(name), kForward).z, 0.5) << "the face is seen, " << name;
  }
}

TEST(PatientPosition, DownIsAlongGravityInTheRoom) {
  for (const int fdi : {38, 48})
    for (const std::string_view name : kPatientPositions) {
      const assets::Patient patient = patientWith(fdi);
      const PatientPosition position = patientPositionNamed(name);
      const glm::dquat R_WP = placePatientAtSite(patient, assets::kFaceAxes_PF, position).rotation;
      const glm::dvec3 down_W = R_WP * downInRoom(patient, assets::kFaceAxes_PF, position).xyz;
      EXPECT_NEAR(glm::length(down_W), 1.0, 1e-12);
      EXPECT_NEAR(down_W.x, 0.0, 1e-12) << "the horizon is level in the picture, " << name;
      EXPECT_LT(down_W.y, 0.0) << name;
      // A surgeon looks down into a lying patient's mouth at 60 degrees.
      if (position == PatientPosition::seated) continue;
      EXPECT_NEAR(down_W.z, -std::sin(calibration::radFromDegrees(60.0)), 1e-12);
    }
}

}  // namespace
}  // namespace app
