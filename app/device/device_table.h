// The devices that are present and the kinds that Molar drives, as text and as JSON: driver, next step, and what no
// real unit has confirmed yet.
#pragma once

#include <string>

#include "app/text/terminal_format.h"
#include "haptics/device/device_catalogue.h"

namespace app {

std::string asText(const haptics::DeviceCatalogue& catalogue, const TerminalFormat& look);
/// {"devices": [{"name", "address", "place", "provenance", "driver", "next_step"}], "kinds": [{"key", "name",
/// "driver", "proved_against", "is_hardware", "ran_on_a_real_unit"}], "troubles":
/// [{"kind", "line"}]}, a search that failed each; kinds as DeviceTrouble, "no-rights"
std::string asJson(const haptics::DeviceCatalogue& catalogue);

}  // namespace app
