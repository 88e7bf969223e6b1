// The command in force during a rehearsal, changed by controls (control.h), a settings file that is polled, or a
// procedure. Commands beyond the limits of servo or device are refused; a law chosen by key is lowered to them instead.
// Every change is recorded before it is in force, and reported. Main thread; the file is polled four times a second.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/controls/control.h"
#include "app/options/live_parameters.h"
#include "app/station/workstation.h"
#include "app/text/message.h"
#include "haptics/servo/command.h"

namespace app {

class ActiveCommand {
 public:
  /// `settings_file` overrides `first`; empty: none. `other_tools`: the rest of the tray, after the first's tool.
  /// Throws UsageError for a command beyond the limits.
  ActiveCommand(const haptics::Command& first, std::vector<haptics::Tool> other_tools, const std::string& settings_file,
                double device_damping_Ns_per_mm, double rate_Hz);

  const haptics::Command& inForce() const { return command_; }
  /// Receives what the surgeon has to know: done or refused, in a few words. None: the terminal alone.
  void speakTo(ReportLine say) { say_ = std::move(say); }
  /// The receiver of changes. Borrowed.
  void attach(Workstation& workstation) { workstation_ = &workstation; }

  /// Executes law, drill, tool (the next of the tray, cyclic), irrigation, assistant, undo, redo and arm (clears a
  /// latched fault whose cause is over); returns false for all others. `where`: file and row of a script, for refusals.
  bool execute(const ControlRequest& request, const std::string& where = {});
  /// Once a frame: reports an undo or redo when the servo has done it, with its volume and what is left.
  void followStrokes(const haptics::Tick& newest);
  void pollSettingsFile(LiveParameters::Clock::time_point now);
  /// Makes a piece of tooth that has fallen apart two; its serial is set here. Unreported.
  void split(const haptics::SplitOrder& order);
  /// Lets a bridge break when enough force comes, alike.
  void arm(const haptics::BreakOrder& order);
  /// Makes a piece ready for forceps or elevator, alike.
  void makeReady(const haptics::SiteOrder& order);
  /// Lets chips leave the volumes, alike.
  void loosen(const haptics::ChipOrder& order);
  /// A flap that was raised from closed gum is held aside, or lies on the bone again. Unreported.
  void layFlapAside(bool is_aside);
  /// A procedure's command, unchecked and unreported; irrigation, hands off, assistant, undo, redo, split, bridge,
  /// site, chips and rearm stay as they are.
  void adopt(const haptics::Command& command);

  /// The hand chooses and neither feels nor works: force fades to zero, nothing turns (haptics::Command::hands_off).
  void takeHandsOff(bool off);
  /// Which of the tray is in the hand.
  std::size_t inHand() const { return in_hand_; }
  /// Tools to change between, in order.
  const std::vector<haptics::Tool>& tray() const { return tray_; }

  /// True once after each change of tool.
  bool takeToolChange();

 private:
  void check(const haptics::Command& command) const;
  void report(const std::string& kind, const std::string& line);
  void put(const haptics::Command& wanted);
  void apply(const haptics::Command& wanted, const std::string& tool = {});
  bool changeLowered(const haptics::Command& wanted, const std::string& where, const char* otherwise,
                     const std::string& tool = {});
  void refuse(const std::string& where, const std::string& why, const std::string& spoken = {});
  void say(const std::string& line) {
    if (say_) say_(line);
  }
  void setSwitch(bool haptics::Command::*which, int value, const std::string& kind, const std::string& when_on,
                 const std::string& when_off);
  void moveStroke(Control control, const std::string& where);
  void rearm(const std::string& where);
  void switchLaw(haptics::LawKind law, const std::string& where);
  void changeTool(int to, const std::string& where);

  haptics::Command command_;
  std::vector<haptics::Tool> tray_;
  std::size_t in_hand_ = 0;  ///< of the tray
  double device_damping_Ns_per_mm_, rate_Hz_;
  std::optional<LiveParameters> file_;
  ReportLine say_;
  Workstation* workstation_ = nullptr;
  bool tool_changed_ = false;

  /// An undo or redo that is under way.
  struct StrokeChange {
    Control control;
    int strokes_before = 0, undone_before = 0, requests = 0;
    std::uint64_t command_serial = 0;
    double restored_before_mm3 = 0.0;
    std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ_before{};
  };
  std::optional<StrokeChange> stroke_change_;
};

}  // namespace app
