#include "app/controls/command_desk.h"

#include <cstdio>
#include <utility>

#include "app/options/command_settings.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

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

bool CommandDesk::obey(const ControlWish& wish) {
  switch (wish.control) {
    case Control::law:
      switchLaw(haptics::kLaws[static_cast<std::size_t>(wish.value)].kind);
      return true;
    case Control::drill:
      return switchDrill(wish.value), true;
    case Control::tool:
      return changeTool(wish.value), true;
    case Control::irrigation:
      return switchIrrigation(wish.value), true;
    case Control::undo:
      return undoStroke(), true;
    case Control::arm:
      return armAgain(), true;
    default:
      return false;
  }
}

void CommandDesk::switchDrill(int on) {
  const bool wanted = on != kNoValue ? on != 0 : !command_.drill_enabled;
  if (wanted == command_.drill_enabled) return;
  command_.drill_enabled = wanted;
  workstation_->change(command_);
}

void CommandDesk::switchIrrigation(int on) {
  const bool wanted = on != kNoValue ? on != 0 : !command_.irrigating;
  if (wanted == command_.irrigating) return;
  command_.irrigating = wanted;
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

void CommandDesk::changeTool(int to) {
  if (tray_.size() < 2) {
    std::fprintf(stderr, "molar: there is one tool only, name more with --tool to change between them\n");
    return;
  }
  const std::size_t next = to != kNoValue ? static_cast<std::size_t>(to) : (in_hand_ + 1) % tray_.size();
  if (next >= tray_.size()) {
    std::fprintf(stderr, "molar: there is no tool %zu, the tray holds %zu, name more with --tool\n", next + 1,
                 tray_.size());
    return;
  }
  haptics::Command wanted = command_;
  wanted.tool = tray_[next];
  try {
    refuseUnlessAdmitted(wanted);
    change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, rate_Hz_));
    in_hand_ = next;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "molar: %s; the old tool stays in the hand\n", error.what());
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
    std::fprintf(stderr, "molar: %s\n", reading->trouble.c_str());
    workstation_->note("parameters", reading->trouble);
  }
}

void CommandDesk::follow(const haptics::Command& command) {
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
