// How time goes in a rehearsal: the loop asks for the next frame's time and what time it is then, and nothing in it
// looks at a clock of its own. At real pace that is the wall's time and the display's; the other one: fast_pace.
#pragma once

#include <chrono>

#include "app/rehearsal/live_view.h"

namespace app {

class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  virtual ~Pace() = default;
  virtual Time now() const = 0;
  /// To the time of the next frame: what the servo has done until then is drawn in it.
  virtual void toNextFrame() = 0;
  /// Whether anybody looks at the frames on the way.
  virtual bool isRealTime() const = 0;
};

/// The servo keeps time by itself; a frame comes as soon as the display has shown the one before.
class RealPace final : public Pace {
 public:
  explicit RealPace(LiveView& picture) : view_(picture) {}
  Time now() const override { return std::chrono::steady_clock::now(); }
  void toNextFrame() override { view_.waitUntilShown(); }
  bool isRealTime() const override { return true; }

 private:
  LiveView& view_;
};

}  // namespace app
