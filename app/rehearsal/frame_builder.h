// From what the servo says to what is drawn: each frame is made of the one before, the newest tick and the command in
// force. Frames P and W as in render::Frame. Pure; any thread, under a microsecond.
#pragma once

#include "app/controls/control.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

/// Before the first tick: the site, no tool.
render::Frame openingFrame(const RehearsalPlan& plan);

/// The tool as the servo holds it, the ghost where the hand is, the bur turning while it drills. A pose that is not
/// believed turns nothing: the tool stays as it was last believed.
render::Frame nextFrame(const render::Frame& before, const haptics::Tick& tick, const haptics::Command& command);

/// The last one: a scripted hand that has withdrawn only hides its work.
render::Frame closingFrame(const render::Frame& last, const haptics::Tick& tick, bool is_moved_by_a_person);

/// As the request has it: `layer` switches one over, `face` fades it; others change nothing.
render::Layers layersAfter(const render::Layers& before, const ControlRequest& request);

}  // namespace app
