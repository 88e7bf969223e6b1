// The state of a session as its page shows it, one JSON text: a page is a pure function of the newest one. What stands
// in the log stands here, and no word that is not kept. Made some five times a second: 0.04 ms, 0.6 ms with 400 notes.
// One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/debrief_guide.h"
#include "app/evaluation/evaluation_course.h"
#include "app/evaluation/voice/voice_state.h"

namespace app {

/// What the log does not tell, as it is now.
struct PageNow {
  std::uint64_t serial = 0;
  std::string session;  ///< its id, for pages that come from another one
  std::int64_t now_ns = 0, began_ns = 0;
  bool may_continue = false;
  std::string hold;  ///< what is missing, in words
  std::optional<double> warm_up_left_s;
  double task_s = 0.0;
  std::function<std::optional<double>(std::string_view id)> measure;  ///< of the task that goes on; may be empty
  struct Point {
    double t_s = 0.0;
    std::optional<double> clearance_mm;
    double force_N = 0.0;
  };
  std::vector<Point> course;
  struct Servo {
    double rate_Hz = 0.0;
    std::uint64_t missed = 0;
  };
  std::optional<Servo> servo;  ///< none: no rehearsal goes on
  bool is_recording = false;
  std::string not_kept;  ///< what is not kept any more, and why: the recording, the log; empty: all is
  std::optional<double> seat_lag_ms;
  std::optional<VoiceState> voice;  ///< none: it is not recorded
  struct Closing {
    bool is_done = false, is_verified = false;
    std::size_t rules = 0, deviate = 0;
    std::string folder;
  };
  std::optional<Closing> closing;
  /// The recording as the surgeon's display shows it.
  struct Debrief {
    double t_s = 0.0, length_s = 0.0, tick_s = 0.001, prepared_share = 0.0, speed = 1.0;
    bool plays = false;
    MomentValues values;
    std::vector<DebriefGuide::Mark> incidents;
  };
  std::optional<Debrief> debrief;  ///< none: none is shown
  std::string debrief_trouble;     ///< why, where one should be
};

class PageState {
 public:
  /// Borrows the first two.
  PageState(const StudyTemplate& study, const EvaluationCourse& course, std::string consent_text,
            std::int64_t began_ns);
  ~PageState();

  /// Each event of the log, in order.
  void add(const LogEvent& event);
  std::string text(const PageNow& now) const;

 private:
  struct Told;
  const StudyTemplate& study_;
  const EvaluationCourse& course_;
  std::string consent_text_;
  std::int64_t began_ns_;
  std::unique_ptr<Told> told_;
};

}  // namespace app
