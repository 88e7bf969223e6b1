// The canals of a treated tooth as they stand in a session: JSON text both ways, for the setup of session_text. Frame
// P, mm. Any thread. Trusts nothing that it reads: numbers out of range, too many places or canals that join nowhere
// throw SessionError.
#pragma once

#include <string>
#include <string_view>

#include "assets/tooth_canals.h"

namespace app {

std::string canalsText(const assets::ToothCanals& tooth);
assets::ToothCanals canalsFrom(std::string_view text);

}  // namespace app
