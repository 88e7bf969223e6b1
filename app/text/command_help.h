// What may be typed, as people are told of it: what the help, the manual and the shell's completion say is made from
// it.
#pragma once

#include <string>
#include <vector>

namespace app {

struct OptionHelp {
  std::string names;          ///< "--out", "-h,--help", or of a word that stands by its place its name
  std::string value;          ///< "FILE", "UINT"; empty: it takes none
  std::string default_value;  ///< its value where it is not given; empty: none, or told in `about`
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
