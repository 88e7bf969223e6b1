// Where the rigs of a workstation are kept: `ROOT/<rig>/<serial>/<mount>/<UTC>.yaml`, nothing ever overwritten, and in
// each folder a file `current` that holds the name of the one in use. Whatever is measured beside a rig (touches) lies
// there under the same name with another ending. A kill at any moment leaves the old current in force. Start-up and
// between rehearsals only. Not for two programs that write at once: the second is refused.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// Of a device at a rig. Names are letters, digits, dot, - and _; an empty serial is kept as "unknown".
struct RigLocation {
  std::string rig_id = "rig", serial, mount = "right";
};

class RigStore {
 public:
  explicit RigStore(std::filesystem::path root) : root_(std::move(root)) {}
  /// $MOLAR_CALIBRATION, else molar/calibration under $XDG_DATA_HOME or ~/.local/share.
  static std::filesystem::path usualRoot();

  /// Every location that has at least one rig.
  std::vector<RigLocation> locations() const;
  /// Names of its files, oldest first. Whatever else lies there is not seen.
  std::vector<std::string> names(const RigLocation& location) const;
  std::filesystem::path pathOf(const RigLocation& location, const std::string& name) const;
  /// Of what checks have found there: drift_history.
  std::filesystem::path historyPath(const RigLocation& location) const;
  std::optional<std::string> currentName(const RigLocation& location) const;
  /// Read and checked: it must be of this serial and mount. Throws CalibrationError.
  std::optional<RigRecord> current(const RigLocation& location) const;

  /// Writes it under its time and, if asked, makes it current; `touches`: what it was fitted to, kept beside it. It
  /// gets the current one as its parent where it has none. Returns its path. Throws CalibrationError and leaves
  /// everything as it was.
  std::filesystem::path keep(const RigLocation& location, const RigRecord& record, const std::string& touches_text,
                             bool make_current);
  /// The one before becomes current again: the current one's parent, else the one before it in time. Returns its name.
  /// Throws CalibrationError when there is none, or it can not be read.
  std::string rollBack(const RigLocation& location);

 private:
  std::filesystem::path folderOf(const RigLocation& location) const;
  /// Of a file that is there; a pointer that is spoilt or leads nowhere is none.
  std::optional<std::string> nameInForce(const RigLocation& location) const;
  std::filesystem::path root_;
};

/// Why a rig must not be used with this device: another model, serial, mount; empty: it may. What is not known of one
/// or the other (empty) is not compared; a rig without a device says nothing against any.
std::string mismatchWith(const RigRecord& record, const std::string& device_model, const std::string& serial,
                         const std::string& mount);

/// Days since it was measured; none without a time.
std::optional<double> age_days(const RigRecord& record, const std::string& now_utc);
inline constexpr double kOldRig_days = 90.0;

}  // namespace calibration
