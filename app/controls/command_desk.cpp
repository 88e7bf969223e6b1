#include "app/controls/command_desk.h"

#include <utility>

#include <fmt/core.h>

#include "app/options/command_settings.h"
#include "app/text/said.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

void refuse(const std::string& where, const std::string& why) { say(where.empty() ? why : where + ": " + why); }

/// What hand, foot and operator decide, neither file nor procedure.
void keepSwitches(const haptics::Command& from, haptics::Command& to) {
  to.irrigating = from.irrigating;
  to.undo_serial = from.undo_serial;
  to.rearm = from.rearm;
}

}  // namespace

CommandDesk::CommandDesk(const haptics::Command& first, std::vector<haptics::Tool> other_tools,
                         const std::string& settings_file, double device_damping_Ns_per_mm, double rate_Hz)
    : command_(first),
      tray_(std::move(other_tools)),
      device_damping_Ns_per_mm_(device_damping_Ns_per_mm),
      rate_Hz_(rate_Hz) {
  tray_.insert(tray_.begin(), first.tool);
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

bool CommandDesk::obey(const ControlWish& wish, const std::string& where) {
  switch (wish.control) {
    case Control::law:
      return switchLaw(haptics::kLaws[static_cast<std::size_t>(wish.value)].kind, where), true;
    case Control::drill:
      return switchDrill(wish.value), true;
    case Control::tool:
      return changeTool(wish.value, where), true;
    case Control::irrigation:
      return switchIrrigation(wish.value), true;
    case Control::undo:
      return undoStroke(where), true;
    case Control::arm:
      return armAgain(where), true;
    default:
      return false;
  }
}

void CommandDesk::switchDrill(int on) {
  const bool wanted = on != kNoValue ? on != 0 : !command_.drill_enabled;
  if (wanted == command_.drill_enabled) return;
  command_.drill_enabled = wanted;
  workstation_->change(command_);
  tell("drill", wanted ? "drill unlocked" : "drill locked");
}

void CommandDesk::switchIrrigation(int on) {
  const bool wanted = on != kNoValue ? on != 0 : !command_.irrigating;
  if (wanted == command_.irrigating) return;
  command_.irrigating = wanted;
  workstation_->change(command_);
  tell("irrigation", command_.irrigating ? "irrigation on" : "irrigation off: the bur turns dry");
}

void CommandDesk::undoStroke(const std::string& where) {
  const unsigned strokes = workstation_->newestTick().strokes;
  if (strokes == 0) return refuse(where, "there is no stroke to take back");
  ++command_.undo_serial;
  workstation_->change(command_);
  tell("undo", "the newest of " + std::to_string(strokes) + (strokes == 1 ? " stroke" : " strokes") + " is taken back");
}

void CommandDesk::armAgain(const std::string& where) {
  if (const haptics::Tick tick = workstation_->newestTick(); tick.dt_s > 0.0 && tick.state == haptics::SafetyState::off)
    return refuse(where, "the motors are off for good, end the rehearsal and start it again");
  ++command_.rearm;
  workstation_->change(command_);
  tell("armed again", "the fault is lifted, if its cause is over");
}

void CommandDesk::switchLaw(haptics::LawKind law, const std::string& where) {
  haptics::Command wanted = command_;
  wanted.law.kind = law;
  try {
    change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, rate_Hz_));
  } catch (const UsageError& error) {
    refuse(where, std::string(error.what()) + "; the old law stays");
  }
}

void CommandDesk::changeTool(int to, const std::string& where) {
  if (tray_.size() < 2 && to == kNoValue)
    return refuse(where, "there is one tool only, name more with --tool to change between them");
  const std::size_t next = to != kNoValue ? static_cast<std::size_t>(to) : (in_hand_ + 1) % tray_.size();
  if (next >= tray_.size())
    return refuse(where, "there is no tool " + std::to_string(next + 1) + ", the tray holds " +
                             std::to_string(tray_.size()) + ", name more with --tool");
  haptics::Command wanted = command_;
  wanted.tool = tray_[next];
  try {
    refuseUnlessAdmitted(wanted);
    change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, rate_Hz_));
    in_hand_ = next;
  } catch (const UsageError& error) {
    refuse(where, std::string(error.what()) + "; the old tool stays in the hand");
  }
}

void CommandDesk::lookAtFile(LiveParameters::Clock::time_point now) {
  if (!file_) return;
  const auto reading = file_->look(now);
  if (!reading) return;
  if (reading->command) {
    haptics::Command wanted = *reading->command;
    wanted.drill_enabled = command_.drill_enabled;
    keepSwitches(command_, wanted);
    change(wanted);
  } else {
    say(reading->trouble);
    workstation_->note("parameters", reading->trouble);
  }
}

void CommandDesk::follow(const haptics::Command& command) {
  haptics::Command wanted = command;
  keepSwitches(command_, wanted);
  put(wanted);
}

/// In force and recorded.
void CommandDesk::put(const haptics::Command& wanted) {
  other_tool_ = other_tool_ || !(command_.tool == wanted.tool);
  command_ = wanted;
  workstation_->change(command_);
}

/// The same, and every difference logged.
void CommandDesk::change(const haptics::Command& wanted) {
  const std::vector<std::string> changes = changesBetween(command_, wanted);
  if (changes.empty()) return;
  put(wanted);
  for (const std::string& line : changes) tell("parameters", line);
}

void CommandDesk::tell(const std::string& kind, const std::string& line) {
  say(fmt::format("at {:.3f} s {}", workstation_->newestTick().t_s, line));
  workstation_->note(kind, line);
}

bool CommandDesk::takeOtherTool() { return std::exchange(other_tool_, false); }

}  // namespace app
