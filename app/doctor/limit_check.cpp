#include <sstream>

#include <fmt/core.h>

#include "app/doctor/checks.h"
#include "app/text/parse_number.h"

namespace app {
namespace {

constexpr unsigned kSysNice = 23, kIpcLock = 14;  // linux/capability.h

/// The command that installs the limits.
std::string limitsText(const std::string& user, int needed) {
  return fmt::format("printf '{} - rtprio {}\\n", user, needed) + user +
         " - memlock unlimited\\n' | sudo tee /etc/security/limits.d/70-molar.conf, then sign in again.";
}

/// The real-time priority in the 40th field of proc(5)'s stat; its second is a name in brackets that may hold blanks.
std::optional<int> realtimePriority(const std::string& stat) {
  constexpr int kPlaceBehindName = 38;
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(stat.substr(name_end + 1));
  std::string field;
  for (int place = 0; place < kPlaceBehindName; ++place)
    if (!(fields >> field)) return {};
  return parseNumber<int>(field);
}

/// The lowest of the kernel's interrupt threads; none: interrupts have no threads here.
struct InterruptThread {
  std::string process, name;
  int priority = 0;
};
std::optional<InterruptThread> lowestInterruptThread(const Machine& machine) {
  std::optional<InterruptThread> lowest;
  for (const auto& entry : entriesOf(machine.proc)) {
    const std::string process = entry.filename().string();
    if (process.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string name = firstLine(entry / "comm").value_or("");
    if (!name.starts_with("irq/")) continue;
    const auto priority = realtimePriority(firstLine(entry / "stat").value_or(""));
    if (priority && (!lowest || *priority < lowest->priority)) lowest = InterruptThread{process, name, *priority};
  }
  return lowest;
}

}  // namespace

Finding checkPriorityLimit(const Machine& machine, int servo_priority) {
  const int needed = haptics::usbPriority(servo_priority);
  const bool may_anything = hasCapability(machine, kSysNice).value_or(false);
  const double most = softLimit(machine, "Max realtime priority").value_or(0.0);
  if (!may_anything && most >= 0.0 && most < needed)
    return {"priority-limit", Health::warn,
            fmt::format("The servo may not have real-time priority: {:.0f} of {} is allowed.", most, needed),
            limitsText(machine.user, needed)};
  const auto lowest = lowestInterruptThread(machine);
  if (lowest && lowest->priority <= needed) {
    constexpr int kInterrupts = haptics::kInterruptPriority;
    return {"priority-limit", Health::warn,
            fmt::format("{} has real-time priority {}, the servo that may wait for it {}.", lowest->name,
                        lowest->priority, servo_priority),
            needed < kInterrupts
                ? fmt::format("sudo chrt -f -p {} {} puts it back where the kernel starts it.", kInterrupts,
                              lowest->process)
                : fmt::format("Give rehearse a --priority of {} or less: the kernel starts them at {}.",
                              kInterrupts - 2, kInterrupts)};
  }
  return {"priority-limit", Health::ok,
          fmt::format("The servo may have real-time priority {}, below the interrupts it waits for.", servo_priority)};
}

Finding checkMemoryLimit(const Machine& machine, int servo_priority) {
  if (hasCapability(machine, kIpcLock).value_or(false))
    return {"memory-limit", Health::ok, "The servo's memory may be kept from being swapped out."};
  const double most_MB = softLimit(machine, "Max locked memory").value_or(0.0) / (1024.0 * 1024.0);
  if (most_MB < 0.0) return {"memory-limit", Health::ok, "The servo's memory may be kept from being swapped out."};
  // A growing program can be locked as a whole only without a limit.
  return {"memory-limit", Health::warn,
          fmt::format("Only {:.0f} MB may be kept from being swapped out: the servo keeps its stack, the bone may go.",
                      most_MB),
          limitsText(machine.user, haptics::usbPriority(servo_priority))};
}

}  // namespace app
