// Notes, bookmarks and problems of an evaluation's log as moments of its recording. Pure; any thread.
#pragma once

#include <vector>

#include "app/debrief/bookmarks.h"
#include "app/study/session_log.h"

namespace app {

/// "note: looks for the pedal"; `with_words` false, and where the words are closed: "note". What has no place in the
/// recording is left out.
std::vector<Bookmark> logBookmarks(const std::vector<LogEvent>& events, double tick_s, bool with_words);

}  // namespace app
