#include "app/device/second_hand.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "app/device/pose_source_table.h"
#include "app/session/session_reader.h"
#include "app/text/usage_error.h"
#include "assets/tooth.h"
#include "haptics/device/device_catalogue.h"
#include "haptics/device/simulated/pose_list_device.h"

namespace app {
namespace {

using calibration::Device;
using calibration::OtherTool;
using calibration::Patient;
using calibration::Pose;
using calibration::World;

/// Enough for any display, and the lowest rate of the devices.
constexpr double kRate_Hz = 500.0;

constexpr char kMouse[] = "mouse";

/// The handle along `z_W`; the instrument's plane of symmetry, x = 0, through `y_W`.
Pose<World, OtherTool> held(const glm::dvec3& y_W, const glm::dvec3& z_W, const glm::dvec3& position_W) {
  const glm::dvec3 z = glm::normalize(z_W), y = glm::normalize(y_W - glm::dot(y_W, z) * z);
  return {glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z))), position_W};
}

/// The mirror shows the origin to an eye in front of it; the handle leads away at 45 degrees, towards `handle_W`.
Pose<World, OtherTool> mirrorHeld(const glm::dvec3& handle_W, const glm::dvec3& position_W) {
  const glm::dvec3 eye_W(0.0, 0.0, 500.0);
  const glm::dvec3 out = glm::normalize(glm::normalize(eye_W - position_W) - glm::normalize(position_W));
  const glm::dvec3 aside = glm::normalize(handle_W - glm::dot(handle_W, out) * out);
  return held(aside - out, out + aside, position_W);
}

/// The scripted pose, next to the tooth wherever the rig has it.
Pose<World, OtherTool> holdNextTo(const assets::Patient& patient, const calibration::Rig& rig, SecondTool tool) {
  Pose<World, OtherTool> hold = scriptedHold(tool, assets::isRight(patient.operatedTooth()));
  hold.translation_mm += (rig.X_WP * calibration::Point<Patient>{patient.focus_P_mm()}).mm;
  return hold;
}

/// `replay:SESSION` of a session that holds the places of one: as they were drawn, without the times it was lost.
std::optional<PoseSource> recordedSecondHand(const SecondHandPlan& plan) {
  constexpr std::string_view kReplay = "replay:";
  constexpr double kFrame_s = 1.0 / 60.0;
  if (!plan.device.starts_with(kReplay)) return {};
  SessionReader session(plan.device.substr(kReplay.size()));
  std::vector<haptics::TimedHandlePose> poses;
  for (const SessionEvent& event : session.events()) {
    if (event.kind != kSecondHandEvent) continue;
    const auto place = secondHandFrom(event.text);
    if (!place || !place->is_tracked) continue;
    const double t_s = static_cast<double>(event.tick) * session.about().dt_s;
    if (!poses.empty() && !(t_s > poses.back().t_s)) poses.pop_back();
    // It held still until the frame before.
    if (!poses.empty() && t_s - poses.back().t_s > 2.0 * kFrame_s) poses.push_back({t_s - kFrame_s, poses.back().X_DH});
    poses.push_back({t_s, {place->X_PO.rotation, place->X_PO.translation_mm}});
  }
  if (poses.empty()) return {};
  PoseSource source;
  source.device = std::make_unique<haptics::PoseListDevice>(std::move(poses));
  source.name = "second hand of a session";
  return source;
}

PoseSource mouseAt(const Pose<World, OtherTool>& hold, const calibration::Rig& rig) {
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{hold.rotation, hold.translation_mm}, false});
  PoseSource source;
  source.mouse = mouse.get();
  source.device = std::move(mouse);
  source.name = kMouse;
  // The mouse's frame D is W.
  const auto X_PW = rig.X_WP.inverse();
  source.X_PD = {X_PW.rotation, X_PW.translation_mm};
  return source;
}

PoseSource deviceOf(const SecondHandPlan& plan, const DeviceOptions& options, const assets::Patient& patient,
                    const calibration::Rig& rig, const Pose<World, OtherTool>& hold) {
  if (plan.device == kMouse) return mouseAt(hold, rig);
  if (auto recorded = recordedSecondHand(plan)) return std::move(*recorded);
  if (plan.device != "scripted") {
    calibration::Rig others = rig;
    others.device.reset(), others.arm.reset();  // of the first device
    others.X_WD = rig.second_X_WD.value_or(Pose<World, Device>{{1.0, 0.0, 0.0, 0.0}, hold.translation_mm});
    PoseSource source = openPoseSource(plan.device, options, patient, others, {});
    if (!source.device->capabilities().has_orientation) fixOrientation(source, others, hold.rotation);
    return source;
  }
  const Pose<Patient, OtherTool> X_PO = rig.X_WP.inverse() * hold;
  PoseSource source;
  source.device = std::make_unique<haptics::PoseListDevice>(
      std::vector<haptics::TimedHandlePose>{{0.0, {X_PO.rotation, X_PO.translation_mm}}});
  source.name = "scripted still hand";
  return source;
}

}  // namespace

Pose<World, OtherTool> scriptedHold(SecondTool tool, bool right_side) {
  // For a tooth on the right, as the surgeon sees it; on the left mirrored.
  const double s = right_side ? 1.0 : -1.0;
  if (tool == SecondTool::mirror) return mirrorHeld({0.9 * s, -0.1, 0.6}, {17.0 * s, 10.0, 23.0});
  return held({-0.46 * s, 0.07, 0.79}, {0.85 * s, -0.05, 0.5}, {15.5 * s, 6.5, 6.0});
}

std::optional<render::MirrorGlass> glassOf(SecondTool tool) {
  if (tool != SecondTool::mirror) return {};
  return render::MirrorGlass{assets::mirrorGlassNormal(), assets::kMirrorGlassRadius_mm};
}

void refuseUnlessSecondHand(const SecondHandPlan& plan, const std::string& first_device) {
  if (plan.device.empty()) return;
  const bool is_device = haptics::isDeviceAddress(plan.device);
  const PoseSourceKind* const kind = poseSourceKindOf(plan.device);
  if (plan.device != "scripted" && plan.device != kMouse && !(kind && kind->holds_any_tool) && !is_device)
    throw UsageError("--second-hand " + plan.device + ": it cannot hold a " +
                     std::string(assets::entryOf(plan.tool).name) +
                     ", choose scripted, mouse, replay:SESSION or a device of molar devices");
  if (plan.device == first_device && is_device)
    throw UsageError("--second-hand " + plan.device + ": the first hand holds this device, name another");
}

SecondHand::SecondHand(const SecondHandPlan& plan, const DeviceOptions& options, const assets::Patient& patient,
                       const calibration::Rig& rig, Ticking ticking)
    : tool_(plan.tool),
      hold_(holdNextTo(patient, rig, plan.tool)),
      device_(deviceOf(plan, options, patient, rig, hold_)) {
  const haptics::DeviceCapabilities& can = device_.device->capabilities();
  name_ = std::string(assets::entryOf(tool_).name) + ", " + device_.name;
  rate_Hz_ = device_.rate_Hz.value_or(std::clamp(kRate_Hz, can.min_rate_Hz, can.max_rate_Hz));
  hand_ = std::make_unique<haptics::InstrumentTracker>(servedAs(*device_.device, ticking), rate_Hz_);
}

void SecondHand::stepTo(double t_s) {
  const auto due = static_cast<std::uint64_t>(std::max(0.0, std::floor(t_s * rate_Hz_ + 1e-6)));
  if (due > hand_->ticks()) hand_->step(due - hand_->ticks());
}

std::optional<Pose<World, OtherTool>> SecondHand::startOfMouse() const {
  return device_.mouse != nullptr ? std::optional(hold_) : std::nullopt;
}

void SecondHand::moveMouse(const Pose<World, OtherTool>& X_WO) {
  if (device_.mouse != nullptr) device_.mouse->setTarget({{X_WO.rotation, X_WO.translation_mm}, false});
}

void SecondHand::dress(render::FrameRenderer& renderer) const {
  renderer.setSecondInstrument(assets::entryOf(tool_).model());
}

void SecondHand::place(render::Frame& frame) {
  const auto state = hand_->newest();
  placed_ = {tool_, state.has_value(), {}};
  frame.second_visible = is_seen_ = state.has_value();
  frame.second_glass = glassOf(tool_);
  if (!state) return;
  const auto X_PO = device_.X_PD * state->X_DH * device_.X_HT;
  frame.X_PO = placed_.X_PO = {X_PO.rotation, X_PO.translation_mm};
}

std::optional<SecondHandPlace> SecondHand::takeMoved() {
  if (!placed_.is_tracked && !taken_) return {};
  if (taken_ && isSamePlace(*taken_, placed_)) return {};
  taken_ = placed_;
  return taken_;
}

std::optional<std::string> SecondHand::takeNews() {
  if (is_seen_ == was_seen_) return std::nullopt;
  was_seen_ = is_seen_;
  if (std::exchange(was_lost_, !is_seen_) == is_seen_)
    return name_ + (is_seen_ ? ": tracked again" : ": it cannot be tracked any more and is not drawn");
  return std::nullopt;
}

}  // namespace app
