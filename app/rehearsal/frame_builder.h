// The frame to draw, made from the previous one, the newest tick and the command in force. Frames P and W as in
// render::Frame. Pure; any thread, under a microsecond.
#pragma once

#include "app/controls/control.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/session/field_clarity.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"
#include "render/volume/ct_slices.h"

namespace app {

/// Before the first tick: the site, no tool.
render::Frame openingFrame(const RehearsalPlan& plan);

/// The tool at the servo's proxy, the ghost tool at the measured pose, the bur rotating while it drills. A pose flagged
/// bad_pose leaves the rotation unchanged.
render::Frame nextFrame(const render::Frame& before, const haptics::Tick& tick, const haptics::Command& command);

/// Pieces of the tooth that have left rest, where the tick left them; BrickUploader shows the others in the jaw.
render::MovedPieces movedPieces(const haptics::Tick& tick);

/// The last frame: a scripted tool that was withdrawn is hidden, as it would cover its work.
render::Frame closingFrame(const render::Frame& last, const haptics::Tick& tick, bool is_moved_by_a_person);

/// Frame::slices_beside_bur_P_mm after that many steps of half a millimetre along the plane's axis of P, within 15 mm.
glm::dvec3 scrolledSlices(const render::Frame& frame, render::SlicePlane plane, double steps);

/// Of the site before the first cut: living bone, moist.
FieldClarity openingClarity(const RehearsalPlan& plan);
/// What covers the site, as drawn.
render::SurgicalField surgicalField(const FieldClarity& clarity);

/// After a request: `layer` toggles one, `clear-tooth`, `deviation` and `insertion` switch theirs, `face` sets its
/// opacity; others change nothing.
render::Layers layersAfter(const render::Layers& before, const ControlRequest& request);

}  // namespace app
