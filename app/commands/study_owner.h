// What the owner of a study does with it as a whole: `molar study keys, withdraw, retain`. Main thread.
#pragma once

#include "app/text/command_line.h"

namespace app {

void addStudyOwnerCommands(CommandLine& study);

}  // namespace app
