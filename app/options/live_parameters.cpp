#include "app/options/live_parameters.h"

#include <sys/stat.h>

#include <utility>

#include "app/options/command_settings.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{250};

}  // namespace

LiveParameters::LiveParameters(std::string path, const haptics::Command& base, Check check)
    : path_(std::move(path)), base_(base), check_(std::move(check)) {}

LiveParameters::Mark LiveParameters::markOf() const {
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
  seen_ = markOf();
  return read();
}

std::optional<LiveParameters::Reading> LiveParameters::look(Clock::time_point now) {
  if (now - looked_ < kBetweenLooks) return std::nullopt;
  looked_ = now;
  const Mark mark = markOf();
  if (mark == seen_) return std::nullopt;
  // Marked before it is read: what is written meanwhile is a change again.
  seen_ = mark;
  try {
    return Reading{read(), {}};
  } catch (const std::runtime_error& error) {
    return Reading{std::nullopt, std::string(error.what()) + "; the old values stay"};
  }
}

}  // namespace app
