#include "app/station/case_reach.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/device/pose_source.h"
#include "calibration/arm/phantom_models.h"

namespace app {
namespace {

using calibration::kOmniGeometry;

/// A cube of 60 mm about a third molar at the origin of P, which stands at the origin of W, axes as W's.
assets::Patient cubeAboutTheTooth() {
  assets::Patient patient;
  patient.ct.grid = {{61, 61, 61}, 1.0, glm::dvec3(-30.0)};
  patient.site.emplace();
  return patient;
}

/// Its device stands where all of the case is in reach, 10 mm nearer and farther too.
calibration::Rig rigInReach() {
  const assets::Patient patient = cubeAboutTheTooth();
  calibration::Rig rig = calibration::desktopRig({640, 400});
  for (double y_mm = -60.0; y_mm <= 60.0; y_mm += 10.0)
    for (double z_mm = -60.0; z_mm <= 60.0; z_mm += 10.0) {
      const auto is_reached = [&](double more_mm) {
        rig.X_WD.translation_mm = {0.0, y_mm, z_mm + more_mm};
        return reachOf(rig, patient, kOmniGeometry).corners_out == 0;
      };
      if (is_reached(10.0) && is_reached(-10.0) && is_reached(0.0)) return rig;
    }
  ADD_FAILURE() << "an Omni reaches it from nowhere";
  return rig;
}

bool has(const std::vector<std::string>& lines, const std::string& part) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

TEST(CaseReach, MeasuresHowFarTheCaseIsOffTheScreen) {
  assets::Patient patient = cubeAboutTheTooth();
  calibration::Rig rig = rigInReach();
  EXPECT_NEAR(farthestOffScreen_mm(rig, patient), 20.0, 1e-9);
  rig.X_WP.translation_mm = {0.0, 0.0, -25.0};
  EXPECT_NEAR(farthestOffScreen_mm(rig, patient), 45.0, 1e-9);
  EXPECT_TRUE(has(caseRemarks(rig, patient, 15.0, ""), "45 mm"));
  EXPECT_TRUE(has(caseRemarks(rig, patient, 15.0, ""), "1.4 mm off")) << "15 mm of head at 500 mm: e z / D";
  EXPECT_FALSE(has(caseRemarks(rig, patient, 2.0, ""), "45 mm")) << "a tracked head";
  // Only what was scanned counts.
  patient.ct.grid.origin_P_mm.z = -10.0;
  EXPECT_NEAR(farthestOffScreen_mm(rig, patient), 35.0, 1e-9);
}

TEST(CaseReach, FindsCornersOutOfReachAndTheSmallestShiftThatHelps) {
  const assets::Patient patient = cubeAboutTheTooth();
  calibration::Rig rig = rigInReach();
  EXPECT_EQ(reachOf(rig, patient, kOmniGeometry).corners_out, 0);
  EXPECT_TRUE(caseRemarks(rig, patient, 15.0, "omni").empty());

  // Moved until it just fails, less than the next step brings it back; far away nothing does.
  while (reachOf(rig, patient, kOmniGeometry).corners_out == 0) rig.X_WP.translation_mm.z += 2.0;
  const Reach reach = reachOf(rig, patient, kOmniGeometry);
  ASSERT_TRUE(reach.suggestion);
  EXPECT_EQ(reach.suggestion->turn_deg, 0.0);
  EXPECT_LE(glm::length(reach.suggestion->by_W_mm), 5.0 + 1e-9);
  EXPECT_TRUE(has(caseRemarks(rig, patient, 2.0, "omni"), "stand the patient 5 mm"));
  rig.X_WP.translation_mm += reach.suggestion->by_W_mm;
  EXPECT_EQ(reachOf(rig, patient, kOmniGeometry).corners_out, 0);

  rig.X_WP.translation_mm = {0.0, 0.0, 300.0};
  EXPECT_EQ(reachOf(rig, patient, kOmniGeometry).corners_out, 8);
  EXPECT_TRUE(has(caseRemarks(rig, patient, 2.0, "omni"), "move the device's base"));
  EXPECT_TRUE(caseRemarks(rig, patient, 2.0, "Novint Falcon").empty());
}

}  // namespace
}  // namespace app
