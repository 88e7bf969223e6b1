// Completion script for bash (zsh: after `bashcompinit`), generated from the command line's description
// (command_words.h): commands, options and the values of options that have choices; file names elsewhere. Main thread.
#pragma once

#include <string>

#include "app/text/command_help.h"

namespace app {

/// `program`: description of the program called `name`, "molar", with all its commands.
std::string bashCompletion(const std::string& name, const CommandHelp& program);

}  // namespace app
