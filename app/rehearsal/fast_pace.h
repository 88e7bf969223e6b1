// Time as fast as the machine can make it: a frame is so many ticks, made on this thread, fewer up to the next request
// of the script and up to the end; what time it is follows from them alone. Nobody looks at the frames on the way, and
// only snapshots are drawn. Main thread.
#pragma once

#include <cstdint>
#include <optional>

#include "app/controls/control_script.h"
#include "app/device/second_hand.h"
#include "app/rehearsal/pace.h"
#include "app/station/workstation.h"

namespace app {

class FastPace final : public Pace {
 public:
  /// Borrows them; `duration_s` as the rehearsal's, none: without end.
  FastPace(Workstation& workstation, SecondHand* second_hand, const ControlScript& script, double rate_Hz,
           std::optional<double> duration_s)
      : workstation_(workstation),
        second_hand_(second_hand),
        script_(script),
        rate_Hz_(rate_Hz),
        duration_s_(duration_s) {}

  Time now() const override;
  void toNextFrame() override;
  bool isRealTime() const override { return false; }

 private:
  Workstation& workstation_;
  SecondHand* second_hand_;
  const ControlScript& script_;
  double rate_Hz_;
  std::optional<double> duration_s_;
  std::uint64_t ticks_ = 0;
};

}  // namespace app
