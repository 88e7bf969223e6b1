#include "app/device/pose_sources.h"

namespace app {

PoseSource openMouse(const std::string&, const PoseSourceContext& at) {
  PoseSource hand;
  const auto X_WT = restingTool();
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{X_WT.rotation, X_WT.translation_mm}, false});
  hand.mouse = mouse.get();
  hand.device = std::move(mouse);
  hand.name = "mouse";
  // The mouse moves in W.
  const auto X_PW = at.rig.X_WP.inverse();
  hand.X_PD = {X_PW.rotation, X_PW.translation_mm};
  return hand;
}

}  // namespace app
