// A command's page of the manual, as `man` reads it (groff's man macros), made from the words of the command line. Main
// thread; text only.
#pragma once

#include <string>

#include "app/text/command_words.h"

namespace app {

/// `name` is the whole command, "molar calibrate fit"; `program` heads the page, "Molar 0.1.0".
std::string manualPage(const std::string& name, const CommandWords& command, const std::string& program);

/// The page's file: "molar-calibrate-fit.1".
std::string manualFile(const std::string& name);

}  // namespace app
