#include <time.h>

#include <fmt/core.h>

#include "app/doctor/checks.h"

namespace app {
namespace {

constexpr double kHighResolution_ns = 1000.0;

/// Read without leaving the program; the others cost a trip to a chip.
bool isQuick(const std::string& source) {
  return source == "tsc" || source == "kvm-clock" || source == "arch_sys_counter" || source.starts_with("hyperv");
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
            "Start a kernel with high-resolution timers: a servo of 1 kHz can not wake on time with these."};
  if (!source.empty() && !isQuick(source))
    return {
        "clock", Health::warn, sentence,
        "Reading it takes microseconds: see whether the kernel's log tells why tsc was given up (dmesg | grep tsc)."};
  return {"clock", Health::ok, sentence};
}

}  // namespace app
