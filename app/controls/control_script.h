// What a script asks for beside moving the hand, and at which tick: tools of the tray by number or by their text,
// actions by the names of the controls. Of a row's time the tick is the first that does not begin before it; there the
// wish is in force. Main thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/device/hand_at_work.h"
#include "haptics/tool/tool.h"

namespace app {

class ControlScript {
 public:
  /// Asks for nothing.
  ControlScript() = default;
  /// `tray`: as the command desk has it. Throws UsageError that names the row.
  ControlScript(const std::vector<HandAsks>& asked, const std::vector<haptics::Tool>& tray, double rate_Hz);

  /// What is due at the tick that comes next, or was already; each once.
  std::vector<ControlWish> takeDue(std::uint64_t next_tick);
  /// Of the next wish; none: nothing more is asked for.
  std::optional<std::uint64_t> nextTick() const;

 private:
  struct Scripted {
    std::uint64_t tick;
    ControlWish wish;
  };
  std::vector<Scripted> wishes_;  ///< in order
  std::size_t taken_ = 0;
};

}  // namespace app
