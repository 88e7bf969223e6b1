// The command in force during a rehearsal and all who may change it: a control (control.h), a settings file that is
// obeyed while it changes, a procedure. What servo and device would execute only in part is refused or, at a key,
// lowered and said. Every change is recorded before it is in force, and said. Main thread; a file is looked at four
// times a second.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/options/live_parameters.h"
#include "app/station/workstation.h"
#include "haptics/servo/command.h"

namespace app {

class ActiveCommand {
 public:
  /// `settings_file` rules over `first`; empty: none. `other_tools`: what a change of tool goes through after the
  /// first. Throws UsageError for what can not be obeyed.
  ActiveCommand(const haptics::Command& first, std::vector<haptics::Tool> other_tools, const std::string& settings_file,
                double device_damping_Ns_per_mm, double rate_Hz);

  const haptics::Command& inForce() const { return command_; }
  /// From now on changes go there. Borrowed.
  void serve(Workstation& workstation) { workstation_ = &workstation; }

  /// What the command has a word for: law, drill, tool (the next of the tray, after the last the first), irrigation,
  /// undo (of the newest stroke; again, of the one before), arm (lifts a latched fault whose cause is over). False: the
  /// request is somebody else's. `where`: it is written, named where it can not be obeyed.
  bool execute(const ControlRequest& request, const std::string& where = {});
  void pollSettingsFile(LiveParameters::Clock::time_point now);
  /// As it is, unsaid: the procedure knows why.
  void follow(const haptics::Command& command);

  /// What may be in the hand, the first one first.
  const std::vector<haptics::Tool>& tray() const { return tray_; }

  /// True once after the tool became another.
  bool takeToolChange();

 private:
  void check(const haptics::Command& command) const;
  void report(const std::string& kind, const std::string& line);
  void put(const haptics::Command& wanted);
  void change(const haptics::Command& wanted);
  void switchDrill(int on);
  void switchIrrigation(int on);
  void undoStroke(const std::string& where);
  void rearm(const std::string& where);
  void switchLaw(haptics::LawKind law, const std::string& where);
  void changeTool(int to, const std::string& where);

  haptics::Command command_;
  std::vector<haptics::Tool> tray_;
  std::size_t in_hand_ = 0;  ///< of the tray
  double device_damping_Ns_per_mm_, rate_Hz_;
  std::optional<LiveParameters> file_;
  Workstation* workstation_ = nullptr;
  bool tool_changed_ = false;
};

}  // namespace app
