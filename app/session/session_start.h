// The start of a recording: initial bone, servo settings, and the title of the case. Frame P, mm. Plain values; any
// thread. Never a person's name or identifier.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/servo_build.h"
#include "app/session/session_calibration.h"
#include "app/session/session_setup.h"
#include "assets/soft_tissue_field.h"
#include "assets/volume_grid.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/command.h"

namespace app {

struct SessionStart {
  std::string patient_title;  ///< assets::Patient::title
  std::string program_version;
  double dt_s = 0.001;  ///< nominal tick length
  assets::VolumeGrid grid;
  std::span<const std::uint8_t> solid;  ///< borrowed by the constructor of the recorder; order of `grid`
  std::span<const std::uint8_t> label;  ///< the same; empty: unlabelled
  haptics::Command command;             ///< from the first tick on
  SessionCalibration calibration = {};
  ServoBuild servo = thisServo();
  SessionSetup setup = {};
  std::string started_utc = {};                          ///< empty: not stored
  const assets::SoftTissueField* soft_tissue = nullptr;  ///< borrowed by the constructor of the recorder; null: none
  /// Borrowed, in the order of `grid`: not 0 in the tooth to be removed (haptics/body/bodies); empty: the jaw is one
  /// body.
  std::span<const std::uint8_t> is_tooth = {};
  /// The same: the solid before what is cut already when it begins; empty: nothing is.
  std::span<const std::uint8_t> whole = {};
  std::span<const std::uint8_t> teeth = {};  ///< the same, numbers of the teeth; empty: not numbered
  /// Borrowed, in the order of `grid`: what is laid into it already; null: nothing is.
  const haptics::Filling::Volumes* laid = nullptr;
};

/// The start as stored, with its voxels; labels are those of this program.
struct StoredStart {
  std::string patient_title, program_version;
  double dt_s = 0.0;
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;
  std::vector<std::uint8_t> whole;     ///< before what was cut already; empty: nothing was, or not stored
  std::vector<std::uint8_t> is_tooth;  ///< empty: one body, or recorded before it was stored
  std::vector<std::uint8_t> teeth;     ///< FDI numbers; empty: none, or recorded before they were stored
  /// What was laid into it already; none: nothing was.
  std::optional<haptics::Filling::Volumes> laid;
  assets::SoftTissueField soft_tissue;            ///< empty: none, or recorded before it was stored
  std::optional<SessionCalibration> calibration;  ///< none: recorded before it was stored
  ServoBuild servo;
  SessionSetup setup;
  std::string started_utc;  ///< empty: recorded before it was stored
};

/// The live volumes before the first tick.
inline haptics::Bodies bodiesAtStart(const StoredStart& start) {
  haptics::Bodies bodies(start.grid, start.solid, start.label, start.is_tooth);
  bodies.leave(start.setup.fragments);
  if (start.laid && bodies.filling() != nullptr) bodies.filling()->begin(*start.laid);
  return bodies;
}

}  // namespace app
