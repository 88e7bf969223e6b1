// `molar doctor`: what this machine has and what it lacks for a rehearsal, each with the next step.

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/doctor/checks.h"
#include "app/doctor/findings_text.h"
#include "app/doctor/haptic_usb.h"
#include "app/text/page_look.h"
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
  const std::string page = options.json ? asJson(findings) : asText(findings, lookOfOutput());
  std::fputs(page.c_str(), stdout);
  return missingAmong(findings) > 0 ? 1 : 0;
}

}  // namespace

void addDoctor(CLI::App& molar, Chosen& chosen) {
  auto o = std::make_shared<DoctorOptions>();
  CLI::App* command = molar.add_subcommand("doctor", "What this machine has and lacks, each with the next step");
  auto* json = command->add_flag("--json", o->json, "For programs");
  command->add_flag("--udev-rules", o->udev_rules, "Print the rules that let you use devices and pedals, nothing else")
      ->excludes(json);
  command->add_option("--sessions", o->sessions, "Folder where recordings go")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_option("--priority", o->priority, "Real-time priority that rehearse is given")
      ->check(CLI::Range(haptics::kLeastServoPriority, haptics::kMostServoPriority))
      ->capture_default_str();
  command->callback([o, &chosen] { chosen.action = [o] { return doctor(*o); }; });
}

}  // namespace app
