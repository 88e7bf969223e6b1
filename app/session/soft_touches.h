// Counts how often and how long the instrument touched each soft tissue, and a turning bur was in it. Fed every tick in
// order, live and from a recording, so that summary, metrics and events agree. kTouchPause_s ends a touch. Any one
// thread; below a microsecond a tick, except for a touch's event.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "haptics/servo/tick.h"

namespace app {

struct SoftTouches {
  struct Count {
    int times = 0;
    double seconds = 0.0;
  };
  std::array<Count, assets::kSoftTissueCount> touched{};  ///< by assets::SoftTissue
  std::array<Count, assets::kSoftTissueCount> cut{};      ///< by a turning bur: errors
};

class SoftTouchCounter {
 public:
  void add(const haptics::Tick& tick);
  const SoftTouches& counts() const { return counts_; }

  /// Beginnings since the last call, for the session's events: "lip touched", "bur on lip", each with its time.
  std::vector<std::string> takeEvents() { return std::exchange(events_, {}); }

 private:
  using FreeSince = std::array<double, assets::kSoftTissueCount>;
  bool count(SoftTouches::Count& count, double& last_s, bool now, const haptics::Tick& tick);

  SoftTouches counts_;
  FreeSince touched_s_ = never(), cut_s_ = never();  ///< when each was last touched
  std::vector<std::string> events_;

  static FreeSince never() {
    FreeSince times{};
    times.fill(-1e9);
    return times;
  }
};

/// In the words of touchesText(); empty: none.
std::string softTouchesText(const std::array<SoftTouches::Count, assets::kSoftTissueCount>& counts);

}  // namespace app
