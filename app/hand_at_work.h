// The hand of a rehearsal: which device, where its frame stands to the patient, how long it works by itself.
// Start-up only; the device then belongs to the workstation.
#pragma once

#include <memory>
#include <optional>

#include "assets/patient.h"
#include "calibration/rig.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/simulated/mouse_device.h"

namespace app {

enum class Hand { mouse, scripted, simulated };

/// As people read it in a recording.
constexpr const char* nameOf(Hand hand) {
  return hand == Hand::mouse ? "mouse" : hand == Hand::scripted ? "scripted hand" : "simulated device";
}

struct HandAtWork {
  std::unique_ptr<haptics::HapticDevice> device;
  haptics::MouseDevice* mouse = nullptr;  ///< set where the window moves the hand
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;
  std::optional<double> duration_s;
};

/// Where the mouse's tool begins: in front of the site.
calibration::Pose<calibration::World, calibration::Tool> restingTool();

/// Throws UsageError where the patient has nothing for a scripted hand to do.
HandAtWork handAtWork(Hand hand, const assets::Patient& patient, const calibration::Rig& rig, double bur_radius_mm);

}  // namespace app
