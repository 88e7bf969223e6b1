// What lies loose or is sewn at the site, as it is drawn, in the rehearsal and of a recording alike: chips, follicle,
// stitches and the places for them. Frame P, mm. Pure; any thread.
#pragma once

#include <optional>
#include <vector>

#include "app/procedure/closure/stitches.h"
#include "app/procedure/debris/follicle.h"
#include "app/procedure/debris/loose_chips.h"
#include "app/procedure/debris/suction_tip.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

/// Of the tool in the hand; none: it is no suction.
std::optional<SuctionTip> suctionOf(const haptics::Tick& tick, const haptics::Command& command);

/// `stitches`: null until a piece is out.
std::vector<render::Bead> siteBeads(const LooseChips& chips, const Follicle& follicle, const Stitches* stitches);

}  // namespace app
