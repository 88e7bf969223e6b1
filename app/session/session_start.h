// What a recording begins with: enough to rebuild the bone and start the servo again, and what to call the case.
// Frame P, mm. Plain values; any thread. Never carries a person's name or identifier.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/servo_build.h"
#include "app/session/session_calibration.h"
#include "assets/volume_grid.h"
#include "haptics/servo/command.h"

namespace app {

struct SessionStart {
  std::string patient_title;  ///< assets::Patient::title
  std::string program_version;
  double dt_s = 0.001;  ///< nominal length of a tick
  assets::VolumeGrid grid;
  std::span<const std::uint8_t> solid;  ///< borrowed while the recording is opened, order of `grid`
  std::span<const std::uint8_t> label;  ///< the same, or empty: unlabelled
  haptics::Command command;             ///< in force from the first tick
  SessionCalibration calibration = {};
  ServoBuild servo = thisServo();
};

/// The same as stored, owning its voxels; labels are those of this program.
struct StoredStart {
  std::string patient_title, program_version;
  double dt_s = 0.0;
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;
  std::optional<SessionCalibration> calibration;  ///< none: recorded before it was
  ServoBuild servo;
};

}  // namespace app
