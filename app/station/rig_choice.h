// Selects the rig of a command: a file, the current one of the store, or a default; checks that it is this device's,
// how good and how old it is. A red rig is refused for a device with an arm unless a reason is given. Start-up only;
// mm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/session_calibration.h"
#include "calibration/record/rig_record.h"
#include "haptics/device/haptic_device.h"

namespace app {

class CommandLine;
class Option;

/// The device that a rig is chosen for.
struct DeviceIdentity {
  enum class Kind { without_hardware, practice, real };
  Kind kind = Kind::without_hardware;
  std::string address;
  std::string model, serial;  ///< model: key of phantom_models, else its name

  bool isCalibrated() const { return kind != Kind::without_hardware; }
};

/// `real`: capabilities of the real device; null without hardware. Throws UsageError for a wrong practice address.
DeviceIdentity deviceIdentity(const std::string& address, const haptics::DeviceCapabilities* real);

struct ChosenRig {
  calibration::RigRecord record;     ///< without its arm if that is another device's
  std::string source;                ///< "rig file rig.yaml", "current rig rig-02", "default rig mirrored"
  SessionCalibration calibration;    ///< as recorded in a session
  std::vector<std::string> remarks;  ///< for the user, a line each
};

class RigOption {
 public:
  /// Adds --rig and --rig-store; with `for_device` also --mount and --despite-calibration.
  Option addTo(CommandLine& command, bool for_device);

  bool isGiven() const { return !rig_.empty(); }
  /// "current…", "mirrored", "desktop": not a file.
  bool isName() const;
  /// Throws CalibrationError for an invalid rig file, before anything slow.
  void refuseUnlessReadable() const;

  /// None: nothing requested, and no unique current rig of this device. Throws UsageError: not this device's, no such
  /// current one, several, or red; CalibrationError for an unreadable file. `now_utc` as in records.
  std::optional<ChosenRig> choose(const DeviceIdentity& device, const std::string& now_utc) const;

 private:
  std::optional<calibration::RigRecord> currentFor(const DeviceIdentity& device, const std::string& rig_id) const;
  void check(ChosenRig& chosen, const DeviceIdentity& device, const std::string& now_utc) const;

  std::string rig_, store_, mount_, despite_;
};

}  // namespace app
