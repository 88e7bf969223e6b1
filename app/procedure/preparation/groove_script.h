// What a scripted hand does with burs that were chosen for it: groove beside groove along the biting surface, sunk into
// it pass by pass, upright, with whatever is in the hand. It knows no ideal and feels nothing: what tries a bur, or a
// study's tasks, without people. Frame P; mm, s. Start-up only, 10 ms.
#pragma once

#include <span>

#include "app/device/pose_source.h"
#include "app/procedure/preparation/crown.h"
#include "haptics/tool/tool.h"

namespace app {

/// Planned for the longest head of the tray: a shorter one begins to cut later.
HandScript grooveScript(const Crown& crown, std::span<const haptics::Tool> tray);

}  // namespace app
