// A command as text for the session: one JSON object, a key a member by its path ("law.agus.stiffness_N_per_mm", units
// and frames as in the members' names), tissues and laws by their keys. Bit-exact both ways; what is no finite number
// is written as "nan", "inf" or "-inf". Keys that a reader does not know it passes by; keys that are not there have
// the value of a Command as it is made. Any thread; allocates.
#pragma once

#include <string>
#include <string_view>

#include "haptics/servo/command.h"

namespace app {

std::string commandText(const haptics::Command& command);

/// Throws SessionError if the text is no object or a known key has a value of another kind.
haptics::Command commandFromText(std::string_view text);

}  // namespace app
