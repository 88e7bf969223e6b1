// What was done to a study: STUDY/audit.jsonl, in the form of a session's log, each line chained to the one before.
// Times are of the wall clock. No names, no words of people: codes, streams, counts. Any thread; milliseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/study/session_log.h"

namespace app {

inline constexpr char kAuditName[] = "audit.jsonl";

/// Seconds since 1970, UTC, by the wall clock.
std::int64_t nowUnix_s();

/// On the disk when it returns. Throws LoadError where the chain is broken, CalibrationError where it cannot be
/// written.
void audit(const std::string& study, std::int64_t now_s, const std::string& did,
           std::vector<std::pair<std::string, LogValue>> what);

/// The newest time that it tells of; none: it is empty, or there is none. Throws LoadError.
std::optional<std::int64_t> newestAudit_s(const std::string& study);

}  // namespace app
