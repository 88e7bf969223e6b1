// Burs as a dentist names them: shape, diameter of the head, ISO size. Shapes by the number code of ISO 6360-2 (ball,
// cylinder, cylinder with round end, cone); a bur of the clinic is called round or fissure. The ISO size is the largest
// diameter of the head in tenths of a millimetre, three digits (ISO 2157). Pure; any thread.
#pragma once

#include <string>

#include "haptics/tool/tool.h"

namespace app {

/// "round 2.3 mm, ISO 023"; without ISO size where the diameter is no tenth of a millimetre.
std::string burName(const haptics::BurShape& head);
/// "extraction forceps", "elevator 301", "Cryer elevator left", "scalpel no. 15", or the bur's.
std::string toolName(const haptics::Tool& tool);

}  // namespace app
