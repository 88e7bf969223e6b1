// What a session says about the hand: times, paths, forces, and what was taken of which tissue. All of it as recorded;
// of schemas 3 and 4 what went by tissue is found by running them again, and none where that is another bone. Frame P;
// mm, N, s. Any thread but the servo; a second for some minutes. Numbers only: what is good or bad is for a report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/session/session_calibration.h"
#include "app/session/session_text.h"

namespace app {

struct SessionMetrics {
  std::string patient_title, program_version;
  std::optional<SessionCalibration> calibration;  ///< none: recorded before sessions told
  bool closed = false;                            ///< ended by the program, not by a kill or a full disk
  std::optional<std::string> missing_log;         ///< killed, and the second file of it is not there
  std::uint64_t ticks = 0, lost = 0, commands = 0, events = 0;
  double duration_s = 0.0;
  double contact_s = 0.0;  ///< the bur shares volume with bone
  double drill_on_s = 0.0;
  double drill_in_contact_s = 0.0;
  double dry_drilling_s = 0.0;  ///< of that, without irrigation
  double path_mm = 0.0;         ///< way of the bur's centre
  double drilling_path_mm = 0.0;
  double max_force_N = 0.0;  ///< served
  double mean_contact_force_N = 0.0;
  double max_depth_mm = 0.0;                                       ///< equivalent depth of the law
  double limited_s = 0.0;                                          ///< the force was clamped or slewed
  double faulty_s = 0.0;                                           ///< the device or its poses could not be believed
  double removed_mm3 = 0.0;                                        ///< without what was taken back
  double returned_mm3 = 0.0;                                       ///< taken back by undoing strokes
  std::optional<RemovedByTissue> removed_mm3_by_label;             ///< none: not recorded
  double work_p50_us = 0.0, work_p99_us = 0.0, work_max_us = 0.0;  ///< CPU time of the servo step as recorded
};

/// Throws SessionError if the file is missing, no session, or damaged.
SessionMetrics metricsOf(const std::string& path);

/// What a person wants to know first, a few short lines.
std::string metricsText(const SessionMetrics& metrics);

/// One JSON object, keys as the fields; labels by the key of their tissue.
std::string metricsJson(const SessionMetrics& metrics);

}  // namespace app
