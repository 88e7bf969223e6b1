// Time of a rehearsal; the loop reads no clock of its own. In real time: the wall clock, and a frame begins when the
// display has shown the previous one. Stepped: a frame is a number of servo ticks made on this thread, never past the
// next request of the script or the end, and the time follows from the ticks; frames are not displayed. Main thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "app/controls/control_script.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/live_view.h"

namespace app {

class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Borrows all. `duration_s`: of the rehearsal; none: without end.
  Pace(Ticking ticking, Equipment& equipment, LiveView& view, const ControlScript& script,
       std::optional<double> duration_s)
      : ticking_(ticking), equipment_(equipment), view_(view), script_(script), duration_s_(duration_s) {}

  bool isRealTime() const { return ticking_ == Ticking::realtime; }
  Time now() const;
  /// Returns at the time of the next frame, which draws what the servo has done until then.
  void toNextFrame();

 private:
  Ticking ticking_;
  Equipment& equipment_;
  LiveView& view_;
  const ControlScript& script_;
  std::optional<double> duration_s_;
  std::uint64_t ticks_ = 0;
};

}  // namespace app
