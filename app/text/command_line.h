// The command line: commands, options, actions. Wraps CLI11, which is slow to compile, for all other sources. Names:
// "--long", or a plain word for a positional argument. Main thread, start-up only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/text/command_help.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace app {

/// An option of a command; each call adds a property.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  /// Placeholder of the value in the help: FILE, WxH, …
  Option& valueNamed(const std::string& name);
  /// The help shows the variable's current value as default.
  Option& showsDefault();
  Option& oneOf(const std::vector<std::string>& values);
  /// Both included.
  Option& from(double low, double high);
  Option& wholeFrom(int low, int high);
  Option& existingFolder();
  /// Exactly `count` numbers, as in "1,2,3".
  Option& numbers(int count);
  Option& separatedByCommas();
  /// One value each time the option is given.
  Option& repeated();
  /// Accepted, but absent from help, manual and completion.
  Option& hidden();
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  Option& chained(const CLI::Option*) { return *this; }

  CLI::Option* option_;
};

class CommandLine {
 public:
  /// The program, which requires one of its commands.
  CommandLine(const std::string& about, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Lives as long as this one.
  CommandLine& command(const std::string& name, const std::string& about);
  void requireCommand();
  /// Listed apart, after the commands for surgeons and technicians.
  CommandLine& forEngineers();
  /// Title in the help over the options that are added from here on.
  void optionGroup(const std::string& title) { option_group_ = title; }
  /// At the top of the help.
  void example(const std::string& line, const std::string& about) { examples_.push_back({line, about}); }

  /// `value` must outlive run() and is set if the option is given. Text, number or list, also as std::optional.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& help);
  /// `take` may throw UsageError.
  Option option(const std::string& name, std::function<void(const std::string&)> take, const std::string& help);
  Option flag(const std::string& name, bool& value, const std::string& help);
  /// Below the options.
  void footer(const std::string& text);

  /// Help of all commands and options added so far, as data.
  CommandHelp help() const;

  /// `action` returns the exit status.
  void does(std::function<int()> action) { action_ = std::move(action); }

  /// Runs the chosen command, or prints help (also without any argument) or version. Throws UsageError for invalid
  /// options, with the closest name for a mistyped one, and what the action throws.
  int run(int argc, const char* const* argv);

 private:
  explicit CommandLine(CLI::App& app);

  Option grouped(CLI::Option* option) const;
  /// The innermost command that was given, and its name: "molar calibrate fit".
  const CommandLine& chosen(std::string& name) const;
  void refuseUnknownCommand(int argc, const char* const* argv) const;
  [[noreturn]] void refuseParse(const std::string& what, const std::vector<std::string>& unexpected) const;

  std::unique_ptr<CLI::App> program_;  ///< of the program itself
  CLI::App& app_;
  std::vector<std::unique_ptr<CommandLine>> commands_;
  std::function<int()> action_;
  std::string group_ = "Commands", option_group_ = "Options";
  std::vector<CommandExample> examples_;
};

}  // namespace app
