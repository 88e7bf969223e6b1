#include "app/command_desk.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include "app/command_settings.h"
#include "app/usage_error.h"

namespace app {
namespace {

/// What hand, foot and operator decide, neither file nor guide.
void keepSwitches(const haptics::Command& from, haptics::Command& to) {
  to.irrigating = from.irrigating;
  to.undo_serial = from.undo_serial;
  to.rearm = from.rearm;
}

}  // namespace

CommandDesk::CommandDesk(const haptics::Command& first, std::vector<haptics::Tool> other_tools,
                         const std::string& settings_file, double device_damping_Ns_per_mm, double rate_Hz)
    : command_(first),
      rack_(std::move(other_tools)),
      device_damping_Ns_per_mm_(device_damping_Ns_per_mm),
      rate_Hz_(rate_Hz) {
  rack_.insert(rack_.begin(), first.tool);
  if (!settings_file.empty()) {
    file_.emplace(settings_file, first, [this](const haptics::Command& c) { check(c); });
    command_ = file_->first();
  }
  check(command_);
}

/// Refuses what the servo or the device would obey only in part.
void CommandDesk::check(const haptics::Command& command) const {
  refuseUnlessObeyed(command);
  refuseUnlessHeld(command, device_damping_Ns_per_mm_, rate_Hz_);
}

void CommandDesk::switchDrill() {
  command_.drill_enabled = !command_.drill_enabled;
  workstation_->change(command_);
}

void CommandDesk::switchIrrigation() {
  command_.irrigating = !command_.irrigating;
  workstation_->change(command_);
  tell("irrigation", command_.irrigating ? "irrigation on" : "irrigation off: the bur turns dry");
}

void CommandDesk::undoStroke() {
  const unsigned strokes = workstation_->newestTick().strokes;
  if (strokes == 0) {
    std::fprintf(stderr, "molar: there is no stroke to take back\n");
    return;
  }
  ++command_.undo_serial;
  workstation_->change(command_);
  tell("undo", "the newest of " + std::to_string(strokes) + (strokes == 1 ? " stroke" : " strokes") + " is taken back");
}

void CommandDesk::armAgain() {
  if (const haptics::Tick tick = workstation_->newestTick();
      tick.dt_s > 0.0 && tick.state == haptics::SafetyState::off) {
    std::fprintf(stderr, "molar: the motors are off for good, end the rehearsal and start it again\n");
    return;
  }
  ++command_.rearm;
  workstation_->change(command_);
  tell("armed again", "the fault is lifted, if its cause is over");
}

void CommandDesk::switchLaw(haptics::LawKind law) {
  haptics::Command wanted = command_;
  wanted.law.kind = law;
  try {
    change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, rate_Hz_));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "molar: %s; the old law stays\n", error.what());
  }
}

void CommandDesk::changeTool() {
  if (rack_.size() < 2) {
    std::fprintf(stderr, "molar: there is one tool only, name more with --tool to change between them\n");
    return;
  }
  const std::size_t next = (in_hand_ + 1) % rack_.size();
  haptics::Command wanted = command_;
  wanted.tool = rack_[next];
  try {
    refuseUnlessAdmitted(wanted);
    change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, rate_Hz_));
    in_hand_ = next;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "molar: %s; the old tool stays in the hand\n", error.what());
  }
}

void CommandDesk::lookAtFile() {
  if (!file_) return;
  const auto reading = file_->look(std::chrono::steady_clock::now());
  if (!reading) return;
  if (reading->command) {
    haptics::Command wanted = *reading->command;
    wanted.drill_enabled = command_.drill_enabled;
    keepSwitches(command_, wanted);
    change(wanted);
  } else {
    std::fprintf(stderr, "molar: %s\n", reading->trouble.c_str());
    workstation_->note("parameters", reading->trouble);
  }
}

void CommandDesk::obey(const haptics::Command& command) {
  haptics::Command wanted = command;
  keepSwitches(command_, wanted);
  command_ = wanted;
  workstation_->change(command_);
}

/// In force, recorded, and every difference logged.
void CommandDesk::change(const haptics::Command& wanted) {
  const std::vector<std::string> changes = changesBetween(command_, wanted);
  if (changes.empty()) return;
  other_bur_ = other_bur_ || !(command_.tool.head == wanted.tool.head);
  command_ = wanted;
  workstation_->change(command_);
  for (const std::string& line : changes) tell("parameters", line);
}

void CommandDesk::tell(const std::string& kind, const std::string& line) {
  std::fprintf(stderr, "molar: at %.3f s %s\n", workstation_->newestTick().t_s, line.c_str());
  workstation_->note(kind, line);
}

bool CommandDesk::takeOtherBur() { return std::exchange(other_bur_, false); }

}  // namespace app
