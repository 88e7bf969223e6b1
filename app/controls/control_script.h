// What a script asks for beside moving the hand, and at which tick: tools of the tray by number or by their text,
// actions by the names of the controls. Of a row's time the tick is the first that does not begin before it; there the
// request is in force. Main thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/device/pose_source.h"
#include "haptics/tool/tool.h"

namespace app {

struct ScriptedRequest {
  ControlRequest request;
  std::string where;  ///< it is written, for people
  bool operator==(const ScriptedRequest&) const = default;
};

class ControlScript {
 public:
  /// Asks for nothing.
  ControlScript() = default;
  /// `tray`: as the command desk has it, the first one in the hand. Throws UsageError that names the row.
  ControlScript(const std::vector<TimedRequest>& asked, const std::vector<haptics::Tool>& tray, double rate_Hz);

  /// What is due at the tick that comes next, or was already; each once.
  std::vector<ScriptedRequest> takeDue(std::uint64_t next_tick);
  /// Of the next request; none: nothing more is asked for.
  std::optional<std::uint64_t> nextTick() const;

 private:
  struct Due {
    std::uint64_t tick;
    ScriptedRequest scripted;
  };
  std::vector<Due> requests_;  ///< in order
  std::size_t taken_ = 0;
};

}  // namespace app
