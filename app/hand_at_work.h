// The hand of a rehearsal: which device, where its frame stands to the patient, how long it works by itself.
// Start-up only; the device then belongs to the workstation.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "assets/patient.h"
#include "calibration/rig.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/simulated/mouse_device.h"

namespace app {

enum class Hand { mouse, scripted, omni, touch, desktop, premium };  // from omni on: simulated

/// Those that `--device` takes, and their names as people read them in a recording.
struct HandName {
  Hand hand;
  std::string_view key;
  const char* name;
};
inline constexpr std::array<HandName, 7> kHands = {{
    {Hand::mouse, "mouse", "mouse"},
    {Hand::scripted, "scripted", "scripted hand"},
    {Hand::omni, "simulated", "simulated Phantom Omni"},
    {Hand::omni, "simulated:omni", "simulated Phantom Omni"},
    {Hand::touch, "simulated:touch", "simulated Touch"},
    {Hand::desktop, "simulated:desktop", "simulated Phantom Desktop"},
    {Hand::premium, "simulated:premium", "simulated Phantom Premium 1.5"},
}};
constexpr const char* nameOf(Hand hand) {
  for (const HandName& one : kHands)
    if (one.hand == hand) return one.name;
  return "";
}

struct HandAtWork {
  std::unique_ptr<haptics::HapticDevice> device;
  haptics::MouseDevice* mouse = nullptr;  ///< set where the window moves the hand
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;
  std::optional<double> duration_s;
};

/// Where the mouse's tool begins: in front of the site.
calibration::Pose<calibration::World, calibration::Tool> restingTool();

/// Throws UsageError where the patient has nothing for a scripted hand to do, or a simulated arm does not reach it.
HandAtWork handAtWork(Hand hand, const assets::Patient& patient, const calibration::Rig& rig, double bur_radius_mm);

}  // namespace app
