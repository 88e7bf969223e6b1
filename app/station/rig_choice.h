// Which rig a command works with: a file, the current one of the store, or one that comes with the program; whether it
// is this device's, how good and how old it is. A rig that is proved red is locked for a device with an arm until a
// word says why it is used all the same. Start-up only; mm.
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

/// For whom a rig is chosen.
struct DeviceIdentity {
  enum class Kind { without_hardware, practice, real };
  Kind kind = Kind::without_hardware;
  std::string address;
  std::string model, serial;  ///< model: key of phantom_models, else its name

  bool isCalibrated() const { return kind != Kind::without_hardware; }
};

/// `real`: what the real device of the address can; null for hands without hardware. Throws UsageError for an address
/// of a practice device that is none.
DeviceIdentity deviceIdentity(const std::string& address, const haptics::DeviceCapabilities* real);

struct ChosenRig {
  calibration::RigRecord record;     ///< without its arm where that is another hand's
  std::string source;                ///< "rig file rig.yaml", "current rig rig-02", "default rig mirrored"
  SessionCalibration calibration;    ///< as a session keeps it
  std::vector<std::string> remarks;  ///< a line each, for the person
};

class RigOption {
 public:
  /// Adds --rig and --rig-store; with `for_device` also --mount and --despite-calibration.
  Option addTo(CommandLine& command, bool for_device);

  bool isGiven() const { return !rig_.empty(); }
  /// "current…", "mirrored", "desktop": not a file.
  bool isName() const;
  /// A rig file that is spoilt is said before anything is waited for. Throws CalibrationError.
  void refuseUnlessReadable() const;

  /// None: nothing was asked for, and no current rig is this device's alone. Throws UsageError: not this device's, no
  /// such current one, several, or red; CalibrationError where a file can not be read. `now_utc` as in records.
  std::optional<ChosenRig> choose(const DeviceIdentity& device, const std::string& now_utc) const;

 private:
  std::optional<calibration::RigRecord> currentFor(const DeviceIdentity& device, const std::string& rig_id) const;
  void judge(ChosenRig& chosen, const DeviceIdentity& device, const std::string& now_utc) const;

  std::string rig_, store_, mount_, despite_;
};

}  // namespace app
