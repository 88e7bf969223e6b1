// Requests of a scripted pose source, by tick: tools of the tray by number or by their text, controls by name. A
// request is in force at the first tick that does not begin before the row's time. Main thread.
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
  std::uint64_t tick = 0;
  ControlRequest request;
  std::string where;  ///< file and row, for messages
  bool operator==(const ScriptedRequest&) const = default;
};

class ControlScript {
 public:
  /// No requests.
  ControlScript() = default;
  /// `tray`: of ActiveCommand, its first tool in the hand. Throws UsageError naming the row.
  ControlScript(const std::vector<TimedRequest>& rows, const std::vector<haptics::Tool>& tray, double rate_Hz);

  /// Due at the next tick or before; each once.
  std::vector<ScriptedRequest> takeDue(std::uint64_t next_tick);
  /// Of the next request, if there is one.
  std::optional<std::uint64_t> nextTick() const;

 private:
  std::vector<ScriptedRequest> requests_;  ///< in order
  std::size_t taken_ = 0;
};

}  // namespace app
