// The machine as its file systems describe it, wherever they are mounted: what the doctor reads. The roots can be any
// folders, so that a machine can be laid out by hand. Reading small files; any thread. Not for what must be asked of a
// driver (OpenGL, monitors, clocks).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Whether the person who runs this may read and write a device node.
bool mayUse(const std::filesystem::path& node);

struct Machine {
  std::filesystem::path proc = "/proc", sys = "/sys", dev = "/dev", etc = "/etc";
  std::filesystem::path runtime;   ///< of the session: where sound servers have their sockets; may be empty
  std::filesystem::path home;      ///< of the person
  std::filesystem::path sessions;  ///< where recordings go
  std::string user = "YOU";
  std::function<bool(const std::filesystem::path&)> may_use = mayUse;

  /// This one, with recordings in `sessions`.
  static Machine here(const std::filesystem::path& sessions);
};

/// The first line without blanks around it; none when the file can not be read.
std::optional<std::string> firstLine(const std::filesystem::path& file);
std::vector<std::string> linesOf(const std::filesystem::path& file);
/// What is in a folder, by name; none when there is no such folder.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);

/// Whether this process holds a capability (linux/capability.h); none when the kernel does not say.
std::optional<bool> hasCapability(const Machine& machine, unsigned number);

/// The soft limit of one resource as /proc/self/limits names it; -1: unlimited.
std::optional<double> softLimit(const Machine& machine, std::string_view resource);

}  // namespace app
