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

struct ScriptedWish {
  ControlWish wish;
  std::string where;  ///< it is written, for people
  bool operator==(const ScriptedWish&) const = default;
};

class ControlScript {
 public:
  /// Asks for nothing.
  ControlScript() = default;
  /// `tray`: as the command desk has it, the first one in the hand. Throws UsageError that names the row.
  ControlScript(const std::vector<HandAsks>& asked, const std::vector<haptics::Tool>& tray, double rate_Hz);

  /// What is due at the tick that comes next, or was already; each once.
  std::vector<ScriptedWish> takeDue(std::uint64_t next_tick);
  /// Of the next wish; none: nothing more is asked for.
  std::optional<std::uint64_t> nextTick() const;

 private:
  struct Due {
    std::uint64_t tick;
    ScriptedWish scripted;
  };
  std::vector<Due> wishes_;  ///< in order
  std::size_t taken_ = 0;
};

}  // namespace app
