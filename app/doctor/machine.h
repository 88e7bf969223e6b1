// The machine as its file systems describe it: what the doctor reads. The roots may be any folders, so that tests can
// lay out a machine. Reads small files; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Whether this user may read and write a device node.
bool mayUse(const std::filesystem::path& node);

struct Machine {
  std::filesystem::path proc = "/proc", sys = "/sys", dev = "/dev", etc = "/etc";
  std::filesystem::path runtime;   ///< of the session, with the sockets of sound servers; may be empty
  std::filesystem::path home;      ///< of the user
  std::filesystem::path sessions;  ///< folder of recordings
  std::string user = "YOU";
  std::function<bool(const std::filesystem::path&)> may_use = mayUse;

  /// This one, with recordings in `sessions`.
  static Machine here(const std::filesystem::path& sessions);
};

/// The trimmed first line; none when the file cannot be read.
std::optional<std::string> firstLine(const std::filesystem::path& file);
std::vector<std::string> linesOf(const std::filesystem::path& file);
/// The entries of a folder, sorted; empty when there is none.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);

/// Whether this process holds a capability (linux/capability.h); none when the kernel does not say.
std::optional<bool> hasCapability(const Machine& machine, unsigned number);

/// The soft limit of one resource as /proc/self/limits names it; -1: unlimited.
std::optional<double> softLimit(const Machine& machine, std::string_view resource);

}  // namespace app
