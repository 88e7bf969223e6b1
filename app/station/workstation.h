// The room while a rehearsal runs: the live bone, the servo on its thread, the hand, the recorder. The one place that
// starts and stops threads. What the frame loop needs of it are values: the newest tick, the dirty bricks, figures. By
// hand (app/device/pose_source) there is no servo thread: step() makes the ticks. Main thread. Construction copies the
// bone and opens the recording (0.1 s); nothing runs before start().
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/device/emergency_exit.h"
#include "app/device/pose_source.h"
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
  /// `keeps_ticks`: for takeTicks(). Throws SessionError or haptics::DeviceError.
  Workstation(const assets::Patient& patient, std::unique_ptr<haptics::HapticDevice> device,
              const haptics::LoopSettings& settings, const haptics::Command& command,
              const std::optional<Recording>& recording, Ticking ticking = Ticking::realtime, bool keeps_ticks = false);

  ~Workstation() { loop_.stop(); }

  /// From now on a crash switches the motors off before it ends the program. Throws haptics::DeviceError.
  void start();
  /// No force from now on, motors off for good; the rehearsal goes on without.
  void emergencyStop() { loop_.emergencyStop(); }
  /// Force to zero, servo ended, recording closed.
  RecordingSummary stop();

  /// By hand alone: so many ticks, written as they come, so that none is lost.
  void step(std::uint64_t ticks);

  /// In force from a tick after this call, by hand from the next; recorded.
  void change(haptics::Command command);
  /// Whether the newest change was in force in this tick.
  bool isApplied(const haptics::Tick& tick) const { return tick.command_serial == command_.serial; }
  void note(const std::string& kind, const std::string& text);

  /// Recorder::temporaryFile.
  std::optional<std::string> temporaryFile() const;
  /// One line, once recording has ended early.
  std::optional<std::string> recordingTrouble() const;

  /// What buttons of the handle and the pedal have asked for since the last call, drilling aside; in no order.
  std::vector<haptics::HandAction> takeActions();

  /// What the device says is wrong, or that a person shall do; empty: nothing.
  std::string deviceTrouble() const { return device_->trouble(); }
  void setHome() { device_->setHome(); }
  haptics::TripCounter trips() { return loop_.trips(); }
  haptics::Tick newestTick() { return newest_.read(); }
  /// Where they are kept: every tick since the last call, oldest first; after 10 s without a call the newest are
  /// missing.
  std::vector<haptics::Tick> takeTicks();
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
  std::optional<haptics::TickLog> kept_ticks_;
  std::unique_ptr<Recorder> recorder_;
  std::uint64_t unwritten_ = 0;  ///< by hand: ticks made since the recorder wrote
  const haptics::FootPedal* pedal_;
  haptics::HapticLoop loop_;
  std::array<std::uint32_t, haptics::kHandActions> actions_taken_{};
  std::optional<EmergencyExit> emergency_exit_;
};

}  // namespace app
