#include "app/case/patient_placement.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace app
