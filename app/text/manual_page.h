// Manual page of a command in groff's man macros, generated from the command line's description (command_words.h).
// Main thread.
#pragma once

#include <string>

#include "app/text/command_help.h"

namespace app {

/// `name`: the full command, "molar calibrate fit". `program`: the page's footer, "Molar 0.1.0".
std::string manualPage(const std::string& name, const CommandHelp& command, const std::string& program);

/// File name of the page: "molar-calibrate-fit.1".
std::string manualFile(const std::string& name);

}  // namespace app
