// Checks the name of a recording before a patient is generated or a device opened; the recorder checks again when it
// opens the file. Main thread, start-up only; a few file-system calls.
#pragma once

#include <initializer_list>
#include <string>

namespace app {

/// Throws UsageError if the file exists and must not be replaced: without `force` always, with it unless it is a
/// complete recording that none of the `devices` replays.
void refuseUnlessRecordable(const std::string& path, bool force, std::initializer_list<std::string> devices = {});

}  // namespace app
