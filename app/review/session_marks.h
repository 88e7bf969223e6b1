// What happened in a recorded session and when, for time lines, reports and debriefs: steps, errors, the coach,
// touches, instruments, undo, pieces of tooth. Never a path or a calibration's name. From events and ticks in order.
// Any one thread; well under a microsecond a tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/session_writer.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

enum class MarkKind : std::uint8_t { step, error, coach, touch, tool, undo, event, bookmark };
/// For people, by kind.
inline constexpr std::array<std::string_view, 8> kMarkNames{"step",       "error", "coach", "touch",
                                                            "instrument", "undo",  "event", "bookmark"};

struct SessionMark {
  double t_s = 0.0;  ///< of a touch: its last moment
  MarkKind kind = MarkKind::event;
  std::string what;
};

class SessionMarks {
 public:
  explicit SessionMarks(std::vector<SessionEvent> events) : events_(std::move(events)) {}

  /// Every tick in order, with its tool.
  void follow(const haptics::Tick& tick, const haptics::Tool& tool);
  /// As they were noted: a touch after what happened until it was over.
  const std::vector<SessionMark>& all() const { return marks_; }

 private:
  std::vector<SessionEvent> events_;
  std::size_t next_ = 0;
  std::vector<SessionMark> marks_;
  double restored_mm3_ = 0.0;
  std::optional<haptics::Tool> tool_;
};

}  // namespace app
