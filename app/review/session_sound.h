// The sound of a recorded rehearsal, made again from its ticks: sample n is heard n / kSoundRate_Hz after the start, to
// a tick. For `molar replay --sound-file`. Any thread; some ten seconds for ten minutes.
#pragma once

#include <string>

namespace app {

inline constexpr int kSoundRate_Hz = 48'000;

/// Writes FLAC to exactly `to`. Returns its length in s. Throws SessionError, UsageError.
double writeSessionSound(const std::string& session_path, const std::string& to);

}  // namespace app
