// What the coach said, as events of a recording. Any thread.
#pragma once

namespace app {

/// Kind of these events; the text is what was said.
inline constexpr char kCoachEvent[] = "coach";

}  // namespace app
