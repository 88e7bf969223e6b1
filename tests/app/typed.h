// A command line with one command, for tests of options.
#pragma once

#include <functional>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "app/text/command_line.h"

namespace tests {

/// `add` adds the options; single quotes group words. Throws UsageError.
inline void type(const std::string& words, const std::function<void(app::CommandLine&)>& add) {
  app::CommandLine program("", "0");
  app::CommandLine& command = program.command("do", "");
  add(command);
  command.does([] { return 0; });
  std::vector<std::string> typed{"program", "do"};
  std::istringstream in(words);
  for (std::string word; in >> std::quoted(word, '\'');) typed.push_back(word);
  std::vector<const char*> arguments;
  for (const std::string& word : typed) arguments.push_back(word.c_str());
  program.run(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace tests
