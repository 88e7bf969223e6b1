// How each pose source without hardware is opened. `rest`: the address after its scheme and colon. Start-up only. Throw
// UsageError where the patient has nothing to cut, an arm does not reach it, or the rest is wrong; SessionError for no
// recording.
#pragma once

#include <string>
#include <string_view>

#include "app/device/pose_source.h"
#include "haptics/device/simulated/trough_path.h"

namespace app {

struct PoseSourceContext {
  const assets::Patient& patient;
  const calibration::Rig& rig;
  const std::optional<assets::PlannedCut>& cut;  ///< none: a script has nothing to do
};

PoseSource openMouse(const std::string& rest, const PoseSourceContext& at);
/// The planned cut; with kThirdMolarScript or kFlapScript a hand that a procedure leads, in front of it.
PoseSource openScript(const std::string& rest, const PoseSourceContext& at);
inline constexpr std::string_view kThirdMolarScript = "third-molar", kFlapScript = "flap";
PoseSource openSimulated(const std::string& model, const PoseSourceContext& at);
/// The scripted hand works at the true site; the tool is drawn where the rig's calibration has it.
PoseSource openPractice(const std::string& unit, const PoseSourceContext& at);
PoseSource openReplay(const std::string& session, const PoseSourceContext& at);
PoseSource openPoses(const std::string& path, const PoseSourceContext& at);

/// From the bur to the handle, W: towards the viewer and down over the lower lip, so that it does not hide the site.
glm::dvec3 shaftDirection_W();

/// How the scripted hand holds the handpiece for a cut: as planned, else between the way in and the line of sight.
haptics::CuttingMotion cuttingMotion(const assets::PlannedCut& cut, const calibration::Rig& rig);

/// A Phantom's base and the tip in its handle: as measured, or as its model has them.
void standAsMeasured(PoseSource& source, const calibration::Rig& rig);

}  // namespace app
