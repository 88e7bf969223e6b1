// Results of a rehearsal, as one screen of text with units: what a surgeon asks, then, after an empty line, what an
// engineer asks. Carries the case's title, no personal data. Pure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/device/pose_source.h"
#include "app/instructor/rehearsal_status.h"
#include "app/rehearsal/warnings.h"
#include "app/session/flap_event.h"
#include "app/session/recorder.h"
#include "app/session/socket_event.h"
#include "app/session/soft_touches.h"
#include "app/session/step_event.h"
#include "app/session/touch_event.h"
#include "app/view/motion_to_photon.h"
#include "assets/tissue.h"
#include "haptics/loop/loop_statistics.h"

namespace app {

struct RehearsalFigures {
  RehearsalStatus last;  ///< at the end
  std::array<double, assets::kTissueCount> removed_mm3{};
  std::optional<double> exposed_share;  ///< of the crown that the plan lays bare; none without a plan for it
  WorkTimes times;
  std::string tooth;                      ///< what it has come apart into, tooth_follower.h; empty: whole
  std::string luxation;                   ///< LuxationLog::summary()
  std::string canals;                     ///< CanalLog::summary()
  std::string way;                        ///< what keeps it in, as looked at last; empty: nobody looked, or it is out
  std::string drawn;                      ///< the cut against the surgeon's own lines; empty: nothing was drawn
  std::optional<FlapRecord> flap;         ///< none: it was raised from the beginning
  std::optional<SocketRecord> socket;     ///< none: no piece is out
  std::optional<ProcedureRun> procedure;  ///< step by step
  Prediction prediction;                  ///< nothing said without a procedure
  std::vector<TouchCount> touched;        ///< teeth and canal
  std::string clearance;                  ///< clearancesInWords(); empty: the drill was not on
  std::vector<Warnings::Count> warnings;
  bool for_engineers = true;  ///< servo, display and latency as well
  bool has_motors = true;
  Ticking ticking = Ticking::realtime;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;                                 ///< mean time between frames
  std::optional<LatencyEstimate> latency, slow_latency;  ///< median and 95th percentile; none without a window
  double first_frame_s = 0.0;  ///< from the user's command to the first frame, loading included
  SoftTouches soft_touches;    ///< lip, cheek, tongue …, and the turning bur on them
  std::optional<RecordingSummary> recording;
  bool recorded_by_default = false;  ///< nobody asked for the recording
};

/// "60031 ticks, 11 deadlines missed, 0 by its own work; late by 32 µs, 99 % below 66, at most 4254; real-time …".
std::string punctualityText(const haptics::LoopFigures& servo);

std::string summaryText(const RehearsalFigures& figures);
/// Its line on the recording; empty: nothing was recorded.
std::string recordingText(const RehearsalFigures& figures);

/// 1 if a recording was requested and is not whole.
inline int exitStatus(const RehearsalFigures& figures) {
  return figures.recording && !figures.recorded_by_default && !figures.recording->isWhole() ? 1 : 0;
}

}  // namespace app
