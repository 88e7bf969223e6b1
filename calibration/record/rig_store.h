// The rig store: `ROOT/<rig>/<serial>/<mount>/<UTC>.yaml`, never overwritten; a file `current` in each folder holds the
// name of the current one. Measured touches are kept next to a rig under the same name with another extension. If the
// program is killed, the old current rig stays in force. Start-up and between rehearsals only. A second concurrent
// writer is refused.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/record/rig_record.h"

namespace calibration {

/// A device at a rig. Names are letters, digits, dot, - and _; an empty serial is stored as "unknown".
struct RigLocation {
  std::string rig_id = "rig", serial, mount = "right";
};

class RigStore {
 public:
  explicit RigStore(std::filesystem::path root) : root_(std::move(root)) {}
  /// $MOLAR_CALIBRATION, else molar/calibration under $XDG_DATA_HOME or ~/.local/share.
  static std::filesystem::path usualRoot();

  /// Locations with at least one rig.
  std::vector<RigLocation> locations() const;
  /// Names of the rig files, oldest first; other files are ignored.
  std::vector<std::string> names(const RigLocation& location) const;
  std::filesystem::path pathOf(const RigLocation& location, const std::string& name) const;
  /// The location's drift_history file.
  std::filesystem::path historyPath(const RigLocation& location) const;
  std::optional<std::string> currentName(const RigLocation& location) const;
  /// Checked for serial and mount. Throws CalibrationError.
  std::optional<RigRecord> current(const RigLocation& location) const;

  /// Writes a rig under its time and, if asked, makes it current; `touches`: those it was fitted to. Sets the current
  /// rig as its parent if it has none. Returns the path. Throws CalibrationError, leaving everything as it was.
  std::filesystem::path keep(const RigLocation& location, const RigRecord& record, const std::string& touches_text,
                             bool make_current);
  /// Makes the previous rig current: the current one's parent, else the one before it in time. Returns its name. Throws
  /// CalibrationError: none, or unreadable.
  std::string rollBack(const RigLocation& location);

 private:
  std::filesystem::path folderOf(const RigLocation& location) const;
  /// The current name if it is valid and its file exists.
  std::optional<std::string> nameInForce(const RigLocation& location) const;
  std::filesystem::path root_;
};

/// Why a rig must not be used with this device: another model, serial or mount. Empty: it may. Empty fields, and a rig
/// without a device, are not compared.
std::string mismatchWith(const RigRecord& record, const std::string& device_model, const std::string& serial,
                         const std::string& mount);

/// Age in days; none without a time.
std::optional<double> age_days(const RigRecord& record, const std::string& now_utc);
inline constexpr double kOldRig_days = 90.0;

}  // namespace calibration
