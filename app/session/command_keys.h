// A command as text: one JSON object with a key per member, named by its path ("law.agus.stiffness_N_per_mm"; units and
// frames in the name); tissues and laws by their keys. Bit-exact both ways; non-finite numbers are "nan", "inf" or
// "-inf". Unknown keys are ignored, missing ones have the default of a Command. Any thread; allocates.
#pragma once

#include <string>
#include <string_view>

#include "haptics/servo/command.h"

namespace app {

std::string commandText(const haptics::Command& command);

/// Throws SessionError if the text is not an object or a known key has a value of another type.
haptics::Command commandFromText(std::string_view text);

}  // namespace app
