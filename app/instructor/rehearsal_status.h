// State of a rehearsal, as plain values, for the instructor's window and the summary. Made twice a second, with an
// instructor ten times. Pure; any thread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/instructor/stroke_times.h"
#include "app/session/measures/clearance_measures.h"
#include "app/session/session_calibration.h"
#include "app/view/motion_to_photon.h"
#include "assets/proposed.h"
#include "haptics/loop/loop_statistics.h"
#include "haptics/safety/trips.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/clearance.h"
#include "render/frame.h"

namespace app {

enum class RecordingState { none, running, ended_early };

struct RehearsalStatus {
  std::string patient_title;
  std::string display;  ///< as in --display
  haptics::Tick tick;   ///< the newest
  haptics::Command command;
  std::string device;
  bool has_motors = true;
  SessionCalibration calibration;
  std::vector<std::string> remarks;  ///< on calibration and case
  haptics::TripCounter trips;
  haptics::LoopFigures servo;
  double servo_rate_Hz = 1000.0;
  double drawing_ms = 0.0;  ///< of the newest frame
  double frames_per_s = 0.0;
  double refresh_Hz = 60.0;
  double budget_ms = 16.7;  ///< for drawing a frame
  LatencyEstimate latency;
  std::string quality;  ///< of the step, as text
  int quality_step = 0;
  bool quality_is_held = false;  ///< chosen by the user
  render::Layers layers;
  double cutting_s = 0.0, dry_s = 0.0;  ///< time with the bur in bone or tooth, and that without water
  std::string said;                     ///< to the surgeon, last
  std::optional<double> gap_mm;    ///< from the bur to tooth or bone as drawn; none: farther than render::kMaxGap_mm
  assets::Proposed proposed = {};  ///< what nobody has confirmed
  haptics::Clearances clearances = {};  ///< of the tool now
  /// The main ones so far (rehearsal/live_measures), and the least clearance of the turning bur.
  std::vector<MeasureValue> measures = {};
  std::array<std::optional<ClearanceMeasures::Least>, assets::kRiskStructures> least = {};
  std::string ruler;  ///< between two touches; empty: none
  std::string way;    ///< what keeps the tooth in; empty: not known
  RecordingState recording = RecordingState::none;
  std::string recording_path;
  StrokeTimes strokes;                    ///< that can be undone and redone
  std::string to_surgeon, to_instructor;  ///< messages of a procedure; a question to the surgeon
};

/// "drilling", "drill off", "drill locked".
const char* drillText(const RehearsalStatus& status);

}  // namespace app
