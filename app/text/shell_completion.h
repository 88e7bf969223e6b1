// What the shell offers when Tab is pressed, as a script for bash (zsh reads it after `bashcompinit`), made from the
// words of the command line: commands, options, and values where there is a choice; files elsewhere. Main thread; text
// only.
#pragma once

#include <string>

#include "app/text/command_words.h"

namespace app {

/// `program` holds the commands of `name`, "molar".
std::string bashCompletion(const std::string& name, const CommandWords& program);

}  // namespace app
