#include <gtest/gtest.h>

#include "calibration/geometry/units.h"
#include "calibration/rig.h"

namespace calibration {
namespace {

struct VirtualScreen {
  Point<World> lower_left, lower_right, upper_left;
};

VirtualScreen seenInMirror(const Rig& rig) {
  return {rig.mirror->reflect(rig.screen.lower_left), rig.mirror->reflect(rig.screen.lower_right),
          rig.mirror->reflect(rig.screen.upper_left)};
}

TEST(MirroredWorkstation, ShowsItsScreenUprightAboutTheOrigin) {
  const Rig rig = mirroredWorkstationRig();
  const VirtualScreen seen = seenInMirror(rig);
  for (const Point<World>& corner : {seen.lower_left, seen.lower_right, seen.upper_left})
    EXPECT_NEAR(corner.mm.z, 0.0, 1e-9);
  EXPECT_LT(glm::length(0.5 * (seen.lower_right.mm + seen.upper_left.mm)), 1e-9) << "centred";
  EXPECT_NEAR(glm::length((seen.lower_right - seen.lower_left).xyz), 531.0, 1e-9);
  EXPECT_NEAR(glm::length((seen.upper_left - seen.lower_left).xyz), 531.0 * 1080 / 1920, 1e-9);
}

TEST(MirroredWorkstation, HasItsPanelTippedForward) {
  const Rig rig = mirroredWorkstationRig();
  const glm::dvec3 right = (rig.screen.lower_right - rig.screen.lower_left).xyz;
  const glm::dvec3 up = (rig.screen.upper_left - rig.screen.lower_left).xyz;
  const glm::dvec3 out = glm::normalize(glm::cross(right, up));
  EXPECT_LT(glm::distance(out, glm::dvec3(0.0, -1.0, 0.0)), 1e-12) << "shines down";
  EXPECT_GT(right.x, 0.0) << "its right stays right";
  EXPECT_GT(up.z, 0.0) << "its upper edge is the nearer";

  // The panel faces the mirror, so the seen screen is left-handed: the whole flip.
  const VirtualScreen seen = seenInMirror(rig);
  EXPECT_LT(glm::cross((seen.lower_right - seen.lower_left).xyz, (seen.upper_left - seen.lower_left).xyz).z, 0.0);
}

TEST(MirroredWorkstation, HasTheMirrorBetweenEyesAndScreenAndTheWorkUnderIt) {
  const Rig rig = mirroredWorkstationRig();
  EXPECT_NEAR(degreesFromRad(std::acos(rig.mirror->normal.z)), 45.0, 1e-9);
  EXPECT_NEAR(glm::length(rig.mirror->normal), 1.0, 1e-12);
  EXPECT_GT(rig.mirror->distance_mm(rig.left_eye), 50.0);
  EXPECT_GT(rig.mirror->distance_mm(rig.right_eye), 50.0);
  const VirtualScreen seen = seenInMirror(rig);
  for (const Point<World>& corner : {seen.lower_left, seen.lower_right, seen.upper_left}) {
    EXPECT_LT(rig.mirror->distance_mm(corner), -30.0);
    EXPECT_GT(rig.mirror->distance_mm(rig.mirror->reflect(corner)), 30.0) << "the panel is above";
  }
  EXPECT_LT(rig.mirror->distance_mm({{70.0, 50.0, 40.0}}), -70.0) << "room for the hand";
  EXPECT_LT(rig.left_eye.mm.x, rig.right_eye.mm.x);
  EXPECT_NEAR(rig.cyclopeanEye().mm.z, 450.0, 1e-12);
}

TEST(MirroredWorkstation, HasThePublishedDevicePose) {
  const Rig rig = mirroredWorkstationRig();
  EXPECT_NEAR(degreesFromRad(glm::angle(rig.X_WD.rotation)), 41.61, 1e-9);
  EXPECT_EQ(rig.X_WD.translation_mm, glm::dvec3(0.0, -55.5, -36.0));
  EXPECT_FALSE(rig.device) << "nothing is measured yet";
  EXPECT_FALSE(rig.arm);
}

TEST(DefaultRigs, AreKnownByTheirNames) {
  EXPECT_TRUE(defaultRig("mirrored")->mirror);
  EXPECT_FALSE(defaultRig("desktop")->mirror);
  EXPECT_FALSE(defaultRig("laptop"));
}

}  // namespace
}  // namespace calibration
