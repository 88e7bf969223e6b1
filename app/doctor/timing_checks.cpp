#include <time.h>

#include <algorithm>
#include <set>
#include <thread>

#include <fmt/core.h>
#include <sys/mman.h>

#include "app/doctor/checks.h"
#include "app/text/list.h"
#include "haptics/device/monotonic_clock.h"
#include "haptics/loop/realtime.h"

namespace app {
namespace {

constexpr double kHighResolution_ns = 1000.0;

/// Read in user space; the others are chips that take microseconds.
bool isQuick(const std::string& source) {
  return source == "tsc" || source == "kvm-clock" || source == "arch_sys_counter" || source.starts_with("hyperv");
}

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::size_t kWakeUps = 500;
constexpr double kPunctual_us = 250.0;  ///< a quarter of a tick

/// On absolute deadlines, as the servo does.
void wakeUp(int priority, std::vector<double>& late_us) {
  haptics::requestRealtime(priority);
  std::int64_t due_ns = haptics::monotonic_ns();
  for (double& late : late_us) {
    due_ns += kPeriod_ns;
    haptics::sleepUntil(due_ns);
    late = 1e-3 * static_cast<double>(haptics::monotonic_ns() - due_ns);
  }
}

/// "cpu7", not "cpufreq".
bool isProcessor(const std::string& name) {
  return name.size() > 3 && name.starts_with("cpu") && name.find_first_not_of("0123456789", 3) == std::string::npos;
}

}  // namespace

double clockResolution_ns() {
  timespec t{};
  clock_getres(CLOCK_MONOTONIC, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

Finding checkClock(const Machine& machine, double resolution_ns) {
  const std::string source =
      firstLine(machine.sys / "devices/system/clocksource/clocksource0/current_clocksource").value_or("");
  const std::string name = source.empty() ? "a clock the kernel does not name" : "clock " + source;
  const std::string sentence = fmt::format("Time comes from {}, in steps of {:.0f} ns.", name, resolution_ns);
  if (resolution_ns > kHighResolution_ns)
    return {"clock", Health::missing, sentence,
            "Start a kernel with high-resolution timers: a servo of 1 kHz cannot wake on time with these."};
  if (!source.empty() && !isQuick(source))
    return {"clock", Health::warn, sentence,
            "Reading it takes microseconds: see in the kernel's log why tsc was given up (dmesg | grep tsc)."};
  return {"clock", Health::ok, sentence};
}

WakeUps measureWakeUps(int servo_priority) {
  std::vector<double> late_us(kWakeUps);
  std::thread(wakeUp, servo_priority, std::ref(late_us)).join();
  munlockall();
  std::ranges::sort(late_us);
  return {late_us[kWakeUps / 2], late_us[kWakeUps * 99 / 100], late_us.back()};
}

Finding checkWakeUps(const WakeUps& measured) {
  Finding finding{"wake-up", Health::ok,
                  fmt::format("A servo at 1 kHz woke {:.0f} µs late (median), {:.0f} µs (99 %), {:.0f} µs at worst.",
                              measured.median_us, measured.p99_us, measured.worst_us)};
  if (measured.p99_us > kPunctual_us) {
    finding.health = Health::warn;
    finding.next_step = "Fix priority-limit and processors below, and close programs that work in the background.";
  }
  return finding;
}

Finding checkProcessors(const Machine& machine) {
  int count = 0;
  std::set<std::string> governors;
  for (const auto& entry : entriesOf(machine.sys / "devices/system/cpu")) {
    if (!isProcessor(entry.filename().string())) continue;
    ++count;
    if (const auto governor = firstLine(entry / "cpufreq/scaling_governor")) governors.insert(*governor);
  }
  const std::string isolated = firstLine(machine.sys / "devices/system/cpu/isolated").value_or("");
  const bool realtime_kernel = firstLine(machine.sys / "kernel/realtime") == "1";

  std::string sentence = fmt::format("{} core{}", count, count == 1 ? "" : "s");
  sentence += governors.empty() ? ", no frequency governor" : ", governor " + joined(governors);
  sentence += isolated.empty() ? ", none isolated" : ", isolated: " + isolated;
  sentence += realtime_kernel ? ", real-time kernel." : ".";
  if (count < 2)
    return {"processors", Health::warn, sentence,
            "Servo and renderer share one core: use a machine with four or more."};
  if (std::ranges::any_of(governors, [](const std::string& one) { return one != "performance"; }))
    return {"processors", Health::warn, sentence,
            "sudo cpupower frequency-set -g performance keeps the cores awake (sudo apt install linux-cpupower)."};
  return {"processors", Health::ok, sentence};
}

}  // namespace app
