#include "app/options/live_parameters.h"

#include <sys/stat.h>

#include <utility>

#include "app/options/command_settings.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kInterval{250};

}  // namespace

LiveParameters::LiveParameters(std::string path, const haptics::Command& base, Check check)
    : path_(std::move(path)), base_(base), check_(std::move(check)) {}

LiveParameters::Version LiveParameters::currentVersion() const {
  struct stat status {};
  if (::stat(path_.c_str(), &status) != 0) return {};
  return {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size, status.st_ino};
}

haptics::Command LiveParameters::read() const {
  assets::TomlReader keys = assets::TomlReader::fromFile(path_);
  const haptics::Command command = commandFromToml(keys, base_);
  try {
    check_(command);
  } catch (const UsageError& error) {
    throw UsageError(path_ + ": " + error.what());
  }
  return command;
}

haptics::Command LiveParameters::first() {
  read_version_ = currentVersion();
  return read();
}

std::optional<LiveParameters::Reading> LiveParameters::poll(Clock::time_point now) {
  if (now - polled_ < kInterval) return std::nullopt;
  polled_ = now;
  const Version version = currentVersion();
  if (version == read_version_) return std::nullopt;
  // Before reading: a write in between counts as another change.
  read_version_ = version;
  try {
    return Reading{read(), {}};
  } catch (const std::runtime_error& error) {
    return Reading{std::nullopt, std::string(error.what()) + "; the old values stay"};
  }
}

}  // namespace app
