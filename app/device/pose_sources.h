// How each hand without hardware begins, one function a file. `rest`: the address behind its scheme and colon.
// Start-up only. Throw UsageError where the patient has nothing for the hand to do, an arm does not reach it, or the
// address goes on wrongly; SessionError for no recording.
#pragma once

#include <string>

#include "app/device/pose_source.h"

namespace app {

/// At what a hand works.
struct PoseSourceContext {
  const assets::Patient& patient;
  const calibration::Rig& rig;
  const std::optional<assets::PlannedCut>& cut;  ///< none: a script has nothing to do
};

PoseSource openMouse(const std::string& rest, const PoseSourceContext& at);
PoseSource openScript(const std::string& rest, const PoseSourceContext& at);
PoseSource openSimulated(const std::string& model, const PoseSourceContext& at);
/// The hand works where the site truly is; what Molar makes of it is the rig's to say.
PoseSource openPractice(const std::string& unit, const PoseSourceContext& at);
PoseSource openReplay(const std::string& session, const PoseSourceContext& at);
PoseSource openPoses(const std::string& path, const PoseSourceContext& at);

/// From the bur to the handle, W: towards the viewer and down over the lower lip, so that it does not hide the site.
glm::dvec3 shaftDirection_W();
/// Where a Phantom stands and how it holds the tool: as measured, or as its model has it.
void standAsMeasured(PoseSource& hand, const calibration::Rig& rig);

}  // namespace app
