// Checks the name of a recording before a patient is generated or a device opened; the recorder checks again when it
// opens the file. Main thread, start-up only; a few file-system calls.
#pragma once

#include <initializer_list>
#include <string>

namespace app {

/// Throws UsageError for what stands there and is not to be replaced: without `force` anything, with it all but a
/// recording, one that is being made, and the session of a `hand` that replays one.
void refuseUnlessRecordable(const std::string& path, bool force, std::initializer_list<std::string> hands = {});

}  // namespace app
