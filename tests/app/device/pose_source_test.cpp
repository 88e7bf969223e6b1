#include "app/device/pose_source.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// Holds one position; reports no rotation, as a Falcon does.
class PositionDevice final : public haptics::HapticDevice {
 public:
  explicit PositionDevice(bool has_orientation) { capabilities_.has_orientation = has_orientation; }
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  void start(haptics::DeviceServo&, double) override {}
  void stop() noexcept override {}
  void motorsOff() noexcept override {}

 private:
  haptics::DeviceCapabilities capabilities_;
};

calibration::Rig tiltedRig() {
  calibration::Rig rig = calibration::desktopRig({640, 400});
  rig.X_WD = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, -2, 0.5))), {20.0, -30.0, 10.0}};
  rig.X_WP = {glm::angleAxis(-0.4, glm::normalize(glm::dvec3(0, 1, 1))), {3.0, 2.0, 1.0}};
  return rig;
}

/// X_WT for a handle at `p_D` without rotation.
calibration::Pose<calibration::World, calibration::Tool> toolAt(const glm::dvec3& p_D, bool has_orientation) {
  const calibration::Rig rig = tiltedRig();
  OpenedDevice opened;
  opened.device = std::make_unique<PositionDevice>(has_orientation);
  const PoseSource source = openPoseSource("falcon", {}, {}, rig, {}, std::move(opened));
  const calibration::Pose<calibration::Device, calibration::Handle> X_DH{{1.0, 0.0, 0.0, 0.0}, p_D};
  return rig.X_WP * source.X_PD * X_DH * source.X_HT;
}

TEST(PoseSource, ADeviceWithoutOrientationHoldsTheToolAsTheMouseDoes) {
  for (const glm::dvec3 p_D : {glm::dvec3(0.0), glm::dvec3(12.0, -20.0, 120.0)}) {
    const auto X_WT = toolAt(p_D, false);
    EXPECT_NEAR(std::abs(glm::dot(X_WT.rotation, restingTool().rotation)), 1.0, 1e-12);
    EXPECT_LT(glm::distance(X_WT.translation_mm, (tiltedRig().X_WD * calibration::Point<calibration::Device>{p_D}).mm),
              1e-9)
        << "its tip is where the handle is";
  }
}

TEST(PoseSource, ADeviceWithOrientationRotatesTheTool) {
  const auto X_WT = toolAt({1.0, 2.0, 3.0}, true);
  EXPECT_NEAR(std::abs(glm::dot(X_WT.rotation, tiltedRig().X_WD.rotation)), 1.0, 1e-12);
}

}  // namespace
}  // namespace app
