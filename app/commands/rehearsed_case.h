// The patient of a rehearsal as the options of `molar rehearse` name it, with what is computed from it: planned cut,
// soft tissue, structures to keep off, difficulty. Main thread; seconds, most of them for the patient.
#pragma once

#include <optional>

#include "app/commands/rehearse_options.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "assets/scenery/face_frame.h"
#include "assets/synthetic/jaw.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"

namespace app {

/// The block to practise on; none: a patient.
std::optional<assets::PracticeTask> practiceOf(const RehearseOptions& options);
/// A block on which a tooth preparation is practised; nullptr: another case.
const assets::PreparationBlock* preparationBlockOf(const RehearseOptions& options);
/// Of either kind.
bool isOnBlock(const RehearseOptions& options);
/// Of one tooth; else of the third molar's extraction.
bool isRootCanal(const RehearseOptions& options);
bool isPreparation(const RehearseOptions& options);
/// A named case, or the built-in patient's single options; the voxels and the seed are asked for by themselves.
assets::JawParameters jawOf(const RehearseOptions& options);
/// Prepared while the surgeon's windows show the progress. False: cancelled.
bool prepareCase(RehearsalPlan& plan, const RehearseOptions& options, const assets::JawParameters& jaw,
                 assets::FacePose& X_PF);
/// Gum that is closed: what cuts and raises it lies on the tray; the assistant of a scripted hand holds from the
/// beginning.
void closeFlap(RehearsalPlan& plan);

}  // namespace app
