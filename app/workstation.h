// The room while a rehearsal runs: the live bone, the servo on its thread, the hand, the recorder. The one place that
// starts and stops threads. What the frame loop needs of it are values: the newest tick, the dirty bricks, figures.
// Main thread. Construction copies the bone and opens the recording (0.1 s); nothing runs before start().
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/emergency_exit.h"
#include "app/session/recorder.h"
#include "assets/patient.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/device/haptic_device.h"
#include "haptics/servo/haptic_loop.h"
#include "haptics/servo/servo.h"

namespace app {

struct Recording {
  std::string path;
  bool overwrite = false;
  SessionCalibration calibration = {};
};

class Workstation {
 public:
  /// Throws SessionError or haptics::DeviceError.
  Workstation(const assets::Patient& patient, std::unique_ptr<haptics::HapticDevice> device,
              const haptics::LoopSettings& settings, const haptics::Command& command,
              const std::optional<Recording>& recording);

  ~Workstation() { loop_.stop(); }

  /// From now on a crash switches the motors off before it ends the program. Throws haptics::DeviceError.
  void start();
  /// No force from now on, motors off for good; the rehearsal goes on without.
  void emergencyStop() { loop_.emergencyStop(); }
  /// Force to zero, servo ended, recording closed.
  RecordingSummary stop();

  /// In force from a tick after this call; recorded.
  void change(haptics::Command command);
  void note(const std::string& kind, const std::string& text);

  /// One line, once recording has ended early.
  std::optional<std::string> recordingTrouble() const;

  /// What buttons of the handle and the pedal have asked for since the last call, drilling aside; in no order.
  std::vector<haptics::HandAction> takeActions();

  /// What the device says is wrong, or that a person shall do; empty: nothing.
  std::string deviceTrouble() const { return device_->trouble(); }
  void setHome() { device_->setHome(); }
  haptics::TripLedger trips() { return loop_.trips(); }
  haptics::Tick newestTick() { return newest_.read(); }
  haptics::CarvedBone& bone() { return bone_; }
  haptics::LoopFigures figures() const { return loop_.figures(); }

 private:
  std::unique_ptr<haptics::HapticDevice> device_;
  haptics::CarvedBone bone_;
  haptics::Servo servo_;
  double rate_Hz_;
  haptics::Command command_;
  haptics::Latest<haptics::Command> commands_;
  haptics::Latest<haptics::Tick> newest_;
  haptics::TickLog log_;
  std::unique_ptr<Recorder> recorder_;
  const haptics::FootPedal* pedal_;
  haptics::HapticLoop loop_;
  std::array<std::uint32_t, haptics::kHandActions> actions_taken_{};
  std::optional<EmergencyExit> emergency_exit_;
};

}  // namespace app
