#include "app/controls/active_command.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/options/bur_name.h"
#include "app/options/command_settings.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// Set by controls only, neither by file nor procedure.
void keepSwitches(const haptics::Command& from, haptics::Command& to) {
  to.hands_off = from.hands_off;
  to.irrigating = from.irrigating;
  to.assistant_holds = from.assistant_holds;
  to.flap_aside = from.flap_aside;
  to.undo_serial = from.undo_serial;
  to.redo_serial = from.redo_serial;
  to.split = from.split;
  to.bridge = from.bridge;
  to.site = from.site;
  to.chips = from.chips;
  to.rearm = from.rearm;
}

bool isSamePose(const haptics::PiecePose& a, const haptics::PiecePose& b) {
  return a.rotation == b.rotation && a.translation_mm == b.translation_mm;
}

}  // namespace

ActiveCommand::ActiveCommand(const haptics::Command& first, std::vector<haptics::Tool> other_tools,
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

void ActiveCommand::refuse(const std::string& where, const std::string& why, const std::string& spoken) {
  printMessage(where.empty() ? why : where + ": " + why);
  say(spoken.empty() ? why : spoken);
}

void ActiveCommand::check(const haptics::Command& command) const {
  refuseBeyondServoLimits(command);
  refuseUnlessStable(command, device_damping_Ns_per_mm_, rate_Hz_);
}

bool ActiveCommand::execute(const ControlRequest& request, const std::string& where) {
  switch (request.control) {
    case Control::law:
      if (static_cast<std::size_t>(request.value) >= haptics::kLaws.size())
        return refuse(where,
                      fmt::format("there is no force law {}, only 1 to {}", request.value + 1, haptics::kLaws.size())),
               true;
      return switchLaw(haptics::kLaws[static_cast<std::size_t>(request.value)].kind, where), true;
    case Control::drill:
      setSwitch(&haptics::Command::drill_enabled, request.value, "drill", "drill unlocked", "drill locked");
      return true;
    case Control::tool:
      return changeTool(request.value, where), true;
    case Control::irrigation:
      setSwitch(&haptics::Command::irrigating, request.value, "irrigation", "irrigation on",
                "irrigation off: the bur cuts dry");
      return true;
    case Control::assistant:
      setSwitch(&haptics::Command::assistant_holds, request.value, "assistant",
                "the assistant holds cheek and flap aside", "the assistant lets go");
      return true;
    case Control::undo:
    case Control::redo:
      return moveStroke(request.control, where), true;
    case Control::arm:
      return rearm(where), true;
    default:
      return false;
  }
}

void ActiveCommand::setSwitch(bool haptics::Command::*which, int value, const std::string& kind,
                              const std::string& when_on, const std::string& when_off) {
  const bool wanted = value != kNoValue ? value != 0 : !(command_.*which);
  if (wanted == command_.*which) return;
  command_.*which = wanted;
  workstation_->change(command_);
  report(kind, wanted ? when_on : when_off);
  say(wanted ? when_on : when_off);
}

void ActiveCommand::moveStroke(Control control, const std::string& where) {
  const bool undoes = control == Control::undo;
  const haptics::Tick tick = workstation_->newestTick();
  // Presses while one is under way count from where that will end.
  int strokes = tick.strokes, undone = tick.undone_strokes;
  if (stroke_change_) {
    const int sign = stroke_change_->control == Control::undo ? 1 : -1;
    strokes = stroke_change_->strokes_before - sign * stroke_change_->requests;
    undone = stroke_change_->undone_before + sign * stroke_change_->requests;
  }
  if (tick.gripped != 0) return refuse(where, "open the forceps first");
  if (tick.lever.piece != 0) return refuse(where, "take the elevator off the tooth first");
  if ((undoes ? strokes : undone) <= 0)
    return refuse(where, undoes ? "there is no stroke to undo" : "there is no undone stroke to redo");
  ++(undoes ? command_.undo_serial : command_.redo_serial);
  workstation_->change(command_);
  if (!stroke_change_ || stroke_change_->control != control)
    stroke_change_ = StrokeChange{control, strokes, undone, 0, 0, tick.restored_total_mm3, tick.X_PQ};
  ++stroke_change_->requests;
  stroke_change_->command_serial = workstation_->commandSerial();
}

void ActiveCommand::followStrokes(const haptics::Tick& newest) {
  if (!stroke_change_ || newest.command_serial < stroke_change_->command_serial ||
      newest.drill_inhibit == haptics::DrillInhibit::undo_running)
    return;
  const double restored_mm3 = newest.restored_total_mm3 - stroke_change_->restored_before_mm3;
  const auto strokes = [](unsigned count) { return fmt::format("{} stroke{}", count, count == 1 ? "" : "s"); };
  const bool undoes = stroke_change_->control == Control::undo;
  // Bone, poses of pieces, or both.
  const bool moved = !std::ranges::equal(stroke_change_->X_PQ_before, newest.X_PQ, isSamePose);
  std::string line = newest.pieces > 1 ? "pieces of the tooth" : "the tooth";
  line = moved ? line + (undoes ? " put back" : " moved again") : "";
  if (!moved || restored_mm3 != 0.0) {
    const double mm3 = undoes ? restored_mm3 : -restored_mm3;
    line = (std::abs(mm3) < 0.05 ? "under 0.1 mm³" : fmt::format("{:.1f} mm³", mm3)) +
           fmt::format(" {}{}{}", undoes ? "taken back" : "cut again", moved ? ", " : "", line);
  }
  line += undoes ? fmt::format(", {} left", strokes(newest.strokes))
                 : fmt::format(", {} left to redo", strokes(newest.undone_strokes));
  report(undoes ? "undo" : "redo", line);
  say(line);
  stroke_change_.reset();
}

void ActiveCommand::rearm(const std::string& where) {
  if (const haptics::Tick tick = workstation_->newestTick(); tick.dt_s > 0.0 && tick.state == haptics::SafetyState::off)
    return refuse(where, "the motors are off for good, end the rehearsal and start it again");
  ++command_.rearm;
  workstation_->change(command_);
  report("armed again", "the fault is lifted, if its cause is over");
  say("the fault is lifted, if its cause is over");
}

void ActiveCommand::switchLaw(haptics::LawKind law, const std::string& where) {
  haptics::Command wanted = command_;
  wanted.law.kind = law;
  changeLowered(wanted, where, "the old law stays");
}

void ActiveCommand::changeTool(int to, const std::string& where) {
  if (tray_.size() < 2 && to == kNoValue)
    return refuse(where, "there is one tool only, name more with --tool to change between them",
                  "there is one tool only");
  const std::size_t next = to != kNoValue ? static_cast<std::size_t>(to) : (in_hand_ + 1) % tray_.size();
  if (next >= tray_.size())
    return refuse(where,
                  fmt::format("there is no tool {}, the tray holds {}, name more with --tool", next + 1, tray_.size()));
  haptics::Command wanted = command_;
  wanted.tool = tray_[next];
  const std::string name = toolName(wanted.tool);
  if (!changeLowered(wanted, where, "the old tool stays in the hand", name)) return;
  in_hand_ = next;
  say(name);
}

/// With gains that the device holds. False: refused.
bool ActiveCommand::changeLowered(const haptics::Command& wanted, const std::string& where, const char* otherwise,
                                  const std::string& tool) {
  try {
    refuseUnlessAdmitted(wanted);
    apply(loweredUntilStable(wanted, device_damping_Ns_per_mm_, rate_Hz_), tool);
    return true;
  } catch (const UsageError& error) {
    refuse(where, std::string(error.what()) + "; " + otherwise);
    return false;
  }
}

void ActiveCommand::pollSettingsFile(LiveParameters::Clock::time_point now) {
  if (!file_) return;
  const auto reading = file_->poll(now);
  if (!reading) return;
  if (reading->command) {
    haptics::Command wanted = *reading->command;
    wanted.drill_enabled = command_.drill_enabled;
    keepSwitches(command_, wanted);
    apply(wanted);
  } else {
    printMessage(reading->error);
    workstation_->note("parameters", reading->error);
  }
}

void ActiveCommand::adopt(const haptics::Command& command) {
  haptics::Command wanted = command;
  keepSwitches(command_, wanted);
  put(wanted);
}

void ActiveCommand::split(const haptics::SplitOrder& order) {
  const std::uint64_t serial = command_.split.serial + 1;
  command_.split = order;
  command_.split.serial = serial;
  workstation_->change(command_);
}

void ActiveCommand::arm(const haptics::BreakOrder& order) {
  const std::uint64_t serial = command_.bridge.serial + 1;
  command_.bridge = order;
  command_.bridge.serial = serial;
  workstation_->change(command_);
}

void ActiveCommand::makeReady(const haptics::SiteOrder& order) {
  const std::uint64_t serial = command_.site.serial + 1;
  command_.site = order;
  command_.site.serial = serial;
  workstation_->change(command_);
}

void ActiveCommand::loosen(const haptics::ChipOrder& order) {
  const std::uint64_t serial = command_.chips.serial + 1;
  command_.chips = order;
  command_.chips.serial = serial;
  workstation_->change(command_);
}

void ActiveCommand::takeHandsOff(bool off) {
  if (command_.hands_off == off) return;
  command_.hands_off = off;
  workstation_->change(command_);
  workstation_->note("ring", off ? "the ring of instruments is open: no force, nothing turns" : "the ring is closed");
}

void ActiveCommand::layFlapAside(bool is_aside) {
  if (command_.flap_aside == is_aside) return;
  command_.flap_aside = is_aside;
  workstation_->change(command_);
}

void ActiveCommand::put(const haptics::Command& wanted) {
  tool_changed_ = tool_changed_ || !(command_.tool == wanted.tool);
  command_ = wanted;
  workstation_->change(command_);
}

/// Reports every difference, that of a tool by its name.
void ActiveCommand::apply(const haptics::Command& wanted, const std::string& tool) {
  const std::vector<std::string> changes = changesBetween(command_, wanted);
  if (changes.empty()) return;
  put(wanted);
  if (!tool.empty()) report("tool", tool);
  for (const std::string& line : changes)
    if (tool.empty() || !line.starts_with("[tool]")) report("parameters", line);
}

void ActiveCommand::report(const std::string& kind, const std::string& line) {
  printMessage(fmt::format("at {:.3f} s {}", workstation_->newestTick().t_s, line));
  workstation_->note(kind, line);
}

bool ActiveCommand::takeToolChange() { return std::exchange(tool_changed_, false); }

}  // namespace app
