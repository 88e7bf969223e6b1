#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "app/doctor/checks.h"
#include "app/text/list.h"

namespace app {
namespace {

/// "cpu7", not "cpufreq".
bool isProcessor(const std::string& name) {
  return name.size() > 3 && name.starts_with("cpu") && name.find_first_not_of("0123456789", 3) == std::string::npos;
}

}  // namespace

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
  sentence += governors.empty() ? ", speed not the system's to choose" : ", governor " + joined(governors);
  sentence += isolated.empty() ? ", none set apart" : ", set apart: " + isolated;
  sentence += realtime_kernel ? ", real-time kernel." : ".";
  if (count < 2)
    return {"processors", Health::warn, sentence, "Servo and picture share one core: use a machine with four or more."};
  if (std::ranges::any_of(governors, [](const std::string& one) { return one != "performance"; }))
    return {"processors", Health::warn, sentence,
            "sudo cpupower frequency-set -g performance keeps the cores awake (sudo apt install linux-cpupower)."};
  return {"processors", Health::ok, sentence};
}

}  // namespace app
