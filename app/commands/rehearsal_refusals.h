// What `molar rehearse` refuses because its options contradict one another or the case. Each throws UsageError with the
// option and what to do. Any thread; a session that is named is read.
#pragma once

#include <string>

#include "app/commands/rehearse_options.h"
#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// A procedure needs a lower third molar that is a body of its own, and bone to begin with.
void refuseUnlessThirdMolar(const RehearsalPlan& plan, const std::string& procedure);
/// Without windows, devices and pedals, which run in real time.
void refuseUnlessSteppable(const RehearseOptions& options);
/// What a block has none of.
void refuseUnlessForBlock(const RehearseOptions& options);
/// Of what an extraction alone has, and without a tooth.
void refuseUnlessForRootCanal(const RehearseOptions& options);
/// A file on the tray that no orifice of the patient's tooth takes.
void refuseTooWide(const RehearsalPlan& plan);
/// What belongs to another task, or asks for a hand that there is none of.
void refuseUnlessForPreparation(const RehearseOptions& options);
/// Lines of another case lie anywhere.
void refuseUnlessDrawnHere(const RehearseOptions& options, const assets::CtVolume& ct);
/// Whatever would help, or leave something unrecorded.
void refuseUnlessAssessable(const RehearseOptions& options);
/// The scripted hand performs the whole operation.
inline constexpr const char* kShownOperation = "scripted:third-molar";
inline constexpr const char* kShownFlap = "scripted:flap";  ///< incision, flap and the planned cut
inline bool isShown(const RehearseOptions& options) { return options.plan.device == kShownOperation; }

}  // namespace app
