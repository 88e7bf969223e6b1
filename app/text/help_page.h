// The page of `molar help COMMAND` and `--help`: what the command does, its form, examples, commands and options in
// groups with ranges and defaults, notes. Pure; any thread.
#pragma once

#include <string>

#include "app/text/command_help.h"
#include "app/text/terminal_format.h"

namespace app {

/// `name`: "molar calibrate fit".
std::string helpPage(const std::string& name, const CommandHelp& command, const TerminalFormat& format);

}  // namespace app
