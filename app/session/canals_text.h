// The canals of a treated tooth as they stand in a session: JSON text both ways, for the setup of session_text. Frame
// P, mm. Any thread. Trusts nothing that it reads: numbers out of range, too many places or canals that join nowhere
// throw SessionError.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/tooth_canals.h"

namespace app {

nlohmann::json canalsJson(const assets::ToothCanals& tooth);
assets::ToothCanals canalsFrom(const nlohmann::json& object);

}  // namespace app
