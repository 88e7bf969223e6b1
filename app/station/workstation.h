// The running rehearsal: live bone, servo on its thread, device, recorder. The only place that starts and stops
// threads. The frame loop reads values: the newest tick, dirty bricks, figures. Stepped (app/device/pose_source) there
// is no servo thread: step() makes the ticks. Main thread. Construction copies the bone and opens the recording (0.1
// s); nothing runs before start().
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
#include "haptics/body/bodies.h"
#include "haptics/device/haptic_device.h"
#include "haptics/servo/haptic_loop.h"
#include "haptics/servo/servo.h"

namespace app {

struct Recording {
  std::string path;
  bool overwrite = false;
  SessionCalibration calibration = {};
  SessionSetup setup = {};
  std::vector<std::uint8_t> whole = {};  ///< solid before what is cut already; empty: nothing is
  bool by_default = false;               ///< nobody asked for it: if it cannot be made, the rehearsal goes on without
  TickTap* tap = nullptr;                ///< borrowed; null: nobody else is told of the ticks
};

class Workstation {
 public:
  /// `keeps_ticks`: for takeTicks(). `soft_tissue`: what the instrument can touch; empty: none. `laid`: into the tooth
  /// before, borrowed by the constructor; null: nothing was. Throws SessionError or haptics::DeviceError.
  Workstation(const assets::Patient& patient, std::unique_ptr<haptics::HapticDevice> device,
              const haptics::LoopSettings& settings, const haptics::Command& command,
              const std::optional<Recording>& recording, Ticking ticking = Ticking::realtime, bool keeps_ticks = false,
              assets::SoftTissueField soft_tissue = {}, const haptics::Filling::Volumes* laid = nullptr);

  ~Workstation() { loop_.stop(); }

  /// From now on a crash switches the motors off first. Throws haptics::DeviceError.
  void start();
  /// Motors off for good; the rehearsal goes on without force.
  void emergencyStop() { loop_.emergencyStop(); }
  /// Force to zero, servo ended, recording closed.
  RecordingSummary stop();

  /// Stepped only: makes ticks and writes them.
  void step(std::uint64_t ticks);
  /// Stepped only: writes at once what step() kept for later.
  void write();

  /// Active from a later tick on, stepped from the next; recorded.
  void change(haptics::Command command);
  std::uint64_t commandSerial() const { return command_.serial; }
  /// Whether the newest command was active in this tick.
  bool isApplied(const haptics::Tick& tick) const { return tick.command_serial == command_.serial; }
  void note(const std::string& kind, const std::string& text);

  /// Recorder::firstFile; none: nothing is recorded.
  std::optional<std::string> recordingFile() const;
  /// Recorder::temporaryFile.
  std::optional<std::string> temporaryFile() const;
  /// A line, if recording has ended early or could not begin.
  std::optional<std::string> recordingTrouble() const;

  /// Requests of handle buttons and pedal since the last call, except drilling and the handle's change of tool; in no
  /// order.
  std::vector<haptics::HandAction> takeActions();
  /// The handle's button that changes the tool: presses so far, and whether it is down.
  struct ToolButton {
    std::uint32_t presses = 0;
    bool held = false;
  };
  ToolButton toolButton() const {
    constexpr auto kTool = haptics::HandAction::tool_change;
    return {loop_.presses(kTool), loop_.held().has(kTool)};
  }

  /// HapticDevice::trouble().
  std::string deviceTrouble() const { return device_->trouble(); }
  void setHome() { device_->setHome(); }
  haptics::TripCounter trips() { return loop_.trips(); }
  haptics::Tick newestTick() { return newest_.read(); }
  /// With keeps_ticks: every tick since the last call, oldest first; after 10 s without a call the newest are missing.
  std::vector<haptics::Tick> takeTicks();
  haptics::Bodies& bodies() { return bodies_; }
  haptics::LoopFigures figures() const { return loop_.figures(); }

 private:
  std::unique_ptr<haptics::HapticDevice> device_;
  haptics::Bodies bodies_;
  const assets::SoftTissueField soft_tissue_;
  haptics::Servo servo_;
  double rate_Hz_;
  haptics::Command command_;
  haptics::Latest<haptics::Command> commands_;
  haptics::Latest<haptics::Tick> newest_;
  haptics::TickLog log_;
  std::optional<haptics::TickLog> kept_ticks_;
  std::string recording_refusal_;  ///< why nothing is recorded; empty: it is, or nothing was planned
  std::unique_ptr<Recorder> recorder_;
  std::uint64_t unwritten_ = 0;  ///< stepped: ticks since the recorder wrote
  const haptics::FootPedal* pedal_;
  haptics::HapticLoop loop_;
  std::array<std::uint32_t, haptics::kHandActions> actions_taken_{};
  std::optional<EmergencyExit> emergency_exit_;
};

}  // namespace app
