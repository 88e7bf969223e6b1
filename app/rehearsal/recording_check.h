// Whether a name may be recorded under, asked before a patient is made or a device opened; what comes up later the
// recorder refuses (session/recording_place). Main thread, start-up only; a few looks at the disk.
#pragma once

#include <initializer_list>
#include <string>

namespace app {

/// Throws UsageError for what stands there and is not to be replaced: without `force` anything, with it all but a
/// recording, one that is being made, and the session of a `hand` that replays one.
void refuseUnlessRecordable(const std::string& path, bool force, std::initializer_list<std::string> hands = {});

}  // namespace app
