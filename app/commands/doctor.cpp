// `molar doctor`: checks this machine for a rehearsal; every finding names the next step.

#include <cstdio>
#include <memory>

#include "app/commands/command.h"
#include "app/doctor/checks.h"
#include "app/doctor/findings_text.h"
#include "app/doctor/haptic_usb.h"
#include "app/text/command_line.h"
#include "app/text/terminal_format.h"
#include "haptics/device/thread_priority.h"

namespace app {
namespace {

struct DoctorOptions {
  bool json = false, udev_rules = false;
  std::string sessions = ".";
  int priority = haptics::kServoPriority;
};

int doctor(const DoctorOptions& options) {
  if (options.udev_rules) {
    std::fputs(udevRules().c_str(), stdout);
    return 0;
  }
  const std::vector<Finding> findings = examine(Machine::here(options.sessions), options.priority);
  const std::string page = options.json ? asJson(findings) : asText(findings, terminalFormat());
  std::fputs(page.c_str(), stdout);
  return missingCount(findings) > 0 ? 1 : 0;
}

}  // namespace

void addDoctor(CommandLine& molar) {
  auto o = std::make_shared<DoctorOptions>();
  CommandLine& command = molar.command("doctor", "What this machine has and lacks, each with the next step");
  Option json = command.flag("--json", o->json, "For programs");
  command.flag("--udev-rules", o->udev_rules, "Print the rules that let you use devices and pedals, nothing else")
      .excludes(json);
  command.option("--sessions", o->sessions, "Folder where recordings go")
      .existingFolder()
      .valueNamed("FOLDER")
      .showsDefault();
  command.option("--priority", o->priority, "Real-time priority that rehearse is given")
      .wholeFrom(haptics::kMinServoPriority, haptics::kMaxServoPriority)
      .showsDefault();
  command.does([o] { return doctor(*o); });
}

}  // namespace app
