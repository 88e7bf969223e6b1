// Words and answers of an event log, sealed row by row: what a person said stands in "sealed" (base64), its time, kind,
// task and severity stay open, so that the log's chain holds whether the key still exists or not. Pure but for
// randomness; any thread; 5 µs an event.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/study/privacy/session_seal.h"
#include "app/study/session_log.h"

namespace app {

/// The data keys that hold what somebody said or answered, by the event's type: "text" of a note, "value" of an answer.
bool isSaid(const LogEvent& event, std::string_view key);

/// `row`: its number in the log. An event without words is returned as it is; where the stream was destroyed its words
/// are left out.
LogEvent sealedEvent(const SessionSeal& seal, LogEvent event, std::uint64_t row);

/// What could not be opened has no words.
struct OpenedEvents {
  std::vector<LogEvent> events;
  std::size_t sealed = 0;  ///< that stay closed: withdrawn, or no key was given
};
/// `session` null: nothing is opened. Throws LoadError: words that were changed or moved.
OpenedEvents openedEvents(std::vector<LogEvent> events, const OpenedSession* session, const std::string& where);

}  // namespace app
