#include "app/doctor/checks.h"
#include "app/printed.h"

namespace app {
namespace {

constexpr unsigned kSysNice = 23, kIpcLock = 14;  // linux/capability.h
constexpr double kServoPriority = 89.0;           ///< as servo/realtime asks for
constexpr double kProgram_MB = 2048.0;

/// The lines themselves, ready to be put there.
std::string limitsFor(const std::string& user) {
  return "printf '" + user + " - rtprio 95\\n" + user +
         " - memlock unlimited\\n' | sudo tee /etc/security/limits.d/70-molar.conf, then sign in again.";
}

}  // namespace

Finding checkPriorityLimit(const Machine& machine) {
  if (hasCapability(machine, kSysNice).value_or(false))
    return {"priority-limit", Health::ok, "The servo may have real-time priority: you may do anything."};
  const double most = softLimit(machine, "Max realtime priority").value_or(0.0);
  if (most < 0.0 || most >= kServoPriority)
    return {"priority-limit", Health::ok, "The servo may have real-time priority."};
  return {"priority-limit", Health::warn,
          printed("The servo may not have real-time priority: %.0f of %.0f is allowed.", most, kServoPriority),
          limitsFor(machine.user)};
}

Finding checkMemoryLimit(const Machine& machine) {
  if (hasCapability(machine, kIpcLock).value_or(false))
    return {"memory-limit", Health::ok, "The servo's memory may be kept from being swapped out."};
  const double most_MB = softLimit(machine, "Max locked memory").value_or(0.0) / (1024.0 * 1024.0);
  if (most_MB < 0.0 || most_MB >= kProgram_MB)
    return {"memory-limit", Health::ok, "The servo's memory may be kept from being swapped out."};
  return {"memory-limit", Health::warn,
          printed("Only %.0f MB may be kept from being swapped out, a rehearsal needs about %.0f MB.", most_MB,
                  kProgram_MB),
          limitsFor(machine.user)};
}

}  // namespace app
