// The command in force during a rehearsal and all who may change it: keys, the operator, a settings file that is obeyed
// while it changes, a guide. What servo and device would obey only in part is refused or, at a key, lowered and said.
// Every change is recorded before it is in force, and said. Main thread; a file is looked at four times a second.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/live_parameters.h"
#include "app/workstation.h"
#include "haptics/servo/command.h"

namespace app {

class CommandDesk {
 public:
  /// `settings_file` rules over `first`; empty: none. `other_tools`: what a change of tool goes through after the
  /// first. Throws UsageError for what can not be obeyed.
  CommandDesk(const haptics::Command& first, std::vector<haptics::Tool> other_tools, const std::string& settings_file,
              double device_damping_Ns_per_mm, double rate_Hz);

  const haptics::Command& inForce() const { return command_; }
  /// From now on changes go there. Borrowed.
  void serve(Workstation& workstation) { workstation_ = &workstation; }

  void switchDrill();
  void switchIrrigation();
  /// Lifts a fault that the safety layer has latched, if its cause is over.
  void armAgain();
  /// Asks the servo for the newest stroke of the drill back; pressed again, for the one before.
  void undoStroke();
  void switchLaw(haptics::LawKind law);
  /// The next tool of the rack into the hand; after the last the first.
  void changeTool();
  void lookAtFile();
  /// As it is, unsaid: the guide knows why.
  void obey(const haptics::Command& command);

  /// True once after the bur became another.
  bool takeOtherBur();

 private:
  void check(const haptics::Command& command) const;
  void tell(const std::string& kind, const std::string& line);
  void change(const haptics::Command& wanted);

  haptics::Command command_;
  std::vector<haptics::Tool> rack_;
  std::size_t in_hand_ = 0;  ///< of the rack
  double device_damping_Ns_per_mm_, rate_Hz_;
  std::optional<LiveParameters> file_;
  Workstation* workstation_ = nullptr;
  bool other_bur_ = false;
};

}  // namespace app
