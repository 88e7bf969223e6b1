#include "app/device/pose_source.h"

#include "app/device/pose_source_table.h"
#include "app/text/usage_error.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

using calibration::Pose;
using calibration::Tool;
using calibration::World;

PoseSource deviceAtWork(OpenedDevice opened, const calibration::Rig& rig) {
  PoseSource hand;
  hand.library = std::move(opened.library);
  hand.device = std::move(opened.device);
  if (hand.library)
    standAsMeasured(hand, rig);
  else
    hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
  return hand;
}

}  // namespace

glm::dvec3 shaftDirection_W() { return glm::normalize(glm::dvec3(0.12, -0.38, 0.92)); }

Pose<World, Tool> restingTool() { return {glm::dquat(glm::dvec3(0, 0, 1), shaftDirection_W()), {0.0, 6.0, 12.0}}; }

void standAsMeasured(PoseSource& hand, const calibration::Rig& rig) {
  hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
  hand.arm = calibration::measuredArm(rig);
  hand.X_HT.translation_mm = hand.arm ? hand.arm->correction.tip_H_mm : calibration::kNominalTip_H_mm;
}

PoseSource openPoseSource(const std::string& address, const DeviceOptions& options, const assets::Patient& patient,
                          const calibration::Rig& rig, const std::optional<assets::PlannedCut>& cut,
                          std::optional<OpenedDevice> opened) {
  refuseUnlessPoseSource(address);
  const PoseSourceKind* const kind = poseSourceKindOf(address);
  PoseSource hand = kind     ? kind->begin(restOf(address), {patient, rig, cut})
                    : opened ? deviceAtWork(std::move(*opened), rig)
                             : deviceAtWork(haptics::openDevice(address, options), rig);
  if (hand.name.empty()) hand.name = hand.device->capabilities().model;
  return hand;
}

}  // namespace app
