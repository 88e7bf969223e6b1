#include "app/device/pose_source.h"

#include "app/device/pose_source_table.h"
#include "app/text/usage_error.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

PoseSource realDevice(OpenedDevice opened, const calibration::Rig& rig, const assets::Patient& patient,
                      const std::optional<assets::PlannedCut>& cut) {
  PoseSource source;
  source.library = std::move(opened.library);
  source.device = std::move(opened.device);
  source.X_PD = rig.X_WP.inverse() * rig.X_WD;
  source.held_by_end = true;
  if (source.library) standAsMeasured(source, rig);
  if (!source.device->capabilities().has_orientation)
    fixOrientation(source, rig, restingTool(rig, patient, cut).rotation);
  return source;
}

}  // namespace

glm::dvec3 shaftDirection_W() { return glm::normalize(glm::dvec3(0.12, -0.38, 0.92)); }

calibration::Pose<calibration::World, calibration::Tool> restingTool() {
  return {glm::dquat(glm::dvec3(0, 0, 1), shaftDirection_W()), {0.0, 6.0, 12.0}};
}

calibration::Pose<calibration::World, calibration::Tool> restingTool(const calibration::Rig& rig,
                                                                     const assets::Patient& patient,
                                                                     const std::optional<assets::PlannedCut>& cut) {
  auto X_WT = restingTool();
  const glm::dvec3 shaft_P = patient.canals     ? patient.canals->frame.axes_P[2]
                             : patient.prepared ? patient.prepared->frame.axes_P[2]
                             : cut              ? cut->shaft_P
                                                : glm::dvec3(0.0);
  if (shaft_P != glm::dvec3(0.0)) X_WT.rotation = glm::dquat(glm::dvec3(0, 0, 1), rig.X_WP.rotation * shaft_P);
  return X_WT;
}

void standAsMeasured(PoseSource& source, const calibration::Rig& rig) {
  source.X_PD = rig.X_WP.inverse() * rig.X_WD;
  source.arm = calibration::measuredArm(rig);
  source.X_HT.translation_mm = source.arm ? source.arm->correction.tip_H_mm : calibration::kNominalTip_H_mm;
}

void fixOrientation(PoseSource& source, const calibration::Rig& rig, const glm::dquat& R_WT) {
  // Such a device reports R_DH = 1, and an offset of the tip would depend on a rotation that is not known.
  source.X_HT = {glm::conjugate(rig.X_WD.rotation) * R_WT, glm::dvec3(0.0)};
}

PoseSource openMouse(const std::string&, const PoseSourceContext& at) {
  PoseSource source;
  const auto X_WT = restingTool(at.rig, at.patient, at.cut);
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{X_WT.rotation, X_WT.translation_mm}, false});
  source.mouse = mouse.get();
  source.device = std::move(mouse);
  source.name = "mouse";
  source.held_by_end = true;
  // The mouse's frame D is W.
  const auto X_PW = at.rig.X_WP.inverse();
  source.X_PD = {X_PW.rotation, X_PW.translation_mm};
  return source;
}

PoseSource openPoseSource(const std::string& address, const DeviceOptions& options, const assets::Patient& patient,
                          const calibration::Rig& rig, const std::optional<assets::PlannedCut>& cut,
                          std::optional<OpenedDevice> opened) {
  refuseUnlessPoseSource(address);
  const PoseSourceKind* const kind = poseSourceKindOf(address);
  PoseSource source = kind     ? kind->open(haptics::addressRest(address), {patient, rig, cut})
                      : opened ? realDevice(std::move(*opened), rig, patient, cut)
                               : realDevice(haptics::openDevice(address, options), rig, patient, cut);
  if (source.name.empty()) source.name = source.device->capabilities().model;
  return source;
}

PoseSource handAlong(HandScript script, const std::string& name) {
  // After the last pose's time, so that its tick happens too.
  constexpr double kLastTick_s = 1e-6;
  PoseSource hand;
  auto posed = std::make_unique<haptics::PoseListDevice>(std::move(script.poses));
  hand.duration_s = posed->duration_s() + kLastTick_s;
  hand.device = std::move(posed);
  hand.requests = std::move(script.requests);
  hand.name = name;
  return hand;
}

haptics::ServedDevice servedAs(haptics::HapticDevice& device, Ticking ticking) {
  if (ticking == Ticking::realtime) return device;
  auto* const simulated = dynamic_cast<haptics::SimulatedDevice*>(&device);
  if (simulated == nullptr)
    throw haptics::DeviceError(device.capabilities().model +
                               ": only a simulated device can go faster than the clock, leave --pace fast out");
  return haptics::ServedDevice::steppedManually(*simulated);
}

}  // namespace app
