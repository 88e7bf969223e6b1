#include "app/rehearsal/recording_check.h"

#include <filesystem>

#include "app/session/file_seal.h"
#include "app/session/recording_file.h"
#include "app/text/usage_error.h"

namespace app {

void refuseUnlessRecordable(const std::string& path, bool force, std::initializer_list<std::string> devices) {
  namespace fs = std::filesystem;
  std::error_code failed;
  if (!fs::exists(path, failed)) return;
  const auto refuse = [&](const char* why) {
    throw UsageError("--record " + path + ": " + why + ", choose another name");
  };
  if (!fs::is_regular_file(path, failed)) refuse("it is not a plain file");
  if (isBeingRecorded(path)) refuse("another program is recording to it");
  for (const std::string& device : devices)
    if (device.starts_with("replay:") && fs::equivalent(device.substr(7), path, failed))
      refuse("it is the session that is replayed");
  if (!force) throw UsageError(path + ": exists already: choose another name for the recording or use --force");
  // Never replaces poses, settings, rigs or models.
  if (fs::file_size(path, failed) > 0 && !hasSessionMark(path))
    refuse("it is no recording, --force replaces nothing else");
}

}  // namespace app
