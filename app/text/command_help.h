// Commands and options as data, from which manual pages and shell completion are generated.
#pragma once

#include <string>
#include <vector>

namespace app {

struct OptionHelp {
  std::string names;          ///< "--out", "-h,--help", or the name of a positional argument
  std::string value;          ///< "FILE", "UINT"; empty: no value
  std::string default_value;  ///< empty: none, or described in `about`
  std::string about;
  std::vector<std::string> choices;  ///< empty: any
  bool is_required = false;
  bool is_positional = false;
};

struct CommandHelp {
  std::string name, about, footer;
  std::vector<OptionHelp> options;
  std::vector<CommandHelp> commands;
};

}  // namespace app
