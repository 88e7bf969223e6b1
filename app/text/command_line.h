// What may stand on the command line: commands, their options, what each does. The one place that reads CLI11, which
// is slow to compile. Names: "--long", or a word that stands by its place. Main thread, start-up only.
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

/// One option, borrowed from its command; each call says more of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  /// What the help calls its value: FILE, WxH, …
  Option& valueNamed(const std::string& name);
  /// The help shows what holds where it is not given: the variable as it is now.
  Option& showsDefault();
  Option& oneOf(const std::vector<std::string>& values);
  /// Both included; what is no number is refused, too.
  Option& from(double low, double high);
  Option& wholeFrom(int low, int high);
  Option& existingFolder();
  /// So many numbers, as in "1,2,3".
  Option& numbers(int count);
  Option& separatedByCommas();
  /// Given once for each value.
  Option& repeated();
  /// Accepted, but absent from help, manual and completion.
  Option& hidden();
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

class CommandLine {
 public:
  /// The program itself, which wants one of its commands.
  CommandLine(const std::string& about, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Lives as long as this one.
  CommandLine& command(const std::string& name, const std::string& about);
  void requireCommand();

  /// The variable outlives run(); it is set where the option is given.
  /// Of text, number or list, optional or not.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& help);
  /// `take` may throw UsageError.
  Option option(const std::string& name, std::function<void(const std::string&)> take, const std::string& help);
  Option flag(const std::string& name, bool& value, const std::string& help);
  /// Below the options.
  void footer(const std::string& text);

  /// All that was added so far.
  CommandHelp words() const;

  /// Its answer is the program's exit status.
  void does(std::function<int()> action) { action_ = std::move(action); }

  /// Does what is asked for; help and version are answers, too. Throws UsageError for what it does not take, and what
  /// the command throws.
  int run(int argc, const char* const* argv);

 private:
  explicit CommandLine(CLI::App& app);

  std::unique_ptr<CLI::App> program_;  ///< of the program itself
  CLI::App& app_;
  std::vector<std::unique_ptr<CommandLine>> commands_;
  std::function<int()> action_;
};

}  // namespace app
