// Commands and options as data, from which help, manual pages and shell completion are generated.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace app {

struct OptionHelp {
  std::string names;          ///< "--out", "-h,--help", or the name of a positional argument
  std::string value;          ///< "FILE", "NUMBER"; empty: no value
  std::string range;          ///< "0.1 to 86400"; empty: any
  std::string group;          ///< title in the help
  std::string default_value;  ///< empty: none, or described in `about`
  std::string about;
  std::vector<std::string> choices;  ///< empty: any
  bool is_required = false;
  bool is_positional = false;
};

struct CommandExample {
  std::string line, about;
};

struct CommandHelp {
  std::string name, about, footer;
  std::string group;  ///< title in the program's help
  std::vector<CommandExample> examples;
  std::vector<OptionHelp> options;
  std::vector<CommandHelp> commands;

  /// It has commands, and does something without them, too.
  bool mayGoWithout() const { return !commands.empty() && std::ranges::any_of(options, &OptionHelp::is_positional); }
};

}  // namespace app
