#include "app/rehearsal/sight_watch.h"

#include <algorithm>

#include "app/session/measures/sight_lines.h"

namespace app {

void SightWatch::noteEyes(const calibration::Rig& rig) {
  const auto X_PW = rig.X_WP.inverse();
  const bool in_stereo = plan_.display != render::DisplayMode::mono;
  const calibration::Point<calibration::World> between_W = rig.cyclopeanEye();
  const EyesPlace eyes{(X_PW * (in_stereo ? rig.left_eye : between_W)).mm,
                       (X_PW * (in_stereo ? rig.right_eye : between_W)).mm, in_stereo};
  if (eyes_ && glm::distance(eyes_->left_P_mm, eyes.left_P_mm) < kEyesMoved_mm &&
      glm::distance(eyes_->right_P_mm, eyes.right_P_mm) < kEyesMoved_mm)
    return;
  eyes_ = eyes;
  event_log_.note(kEyesEvent, eyesText(eyes));
}

void SightWatch::followHand(SecondHand* hand, const haptics::Tick& newest, bool irrigating, render::Frame& picture) {
  if (hand == nullptr) return;
  hand->place(picture);
  if (picture.second_glass) {
    const double away_mm = glm::distance(picture.X_PO.translation_mm, picture.site_P.mm);
    fog_.step(newest.t_s + newest.dt_s, {away_mm, newest.drilling, irrigating});
    picture.second_glass->fog = fog_.share();
  }
  const auto moved = hand->takeMoved();
  if (!moved) return;
  second_hand_ = moved;
  event_log_.note(kSecondHandEvent, secondHandText(*moved));
}

bool SightWatch::worksOutOfSight(std::span<const haptics::Tick> ticks, const haptics::Command& command,
                                 const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid) const {
  if (!eyes_ || !command.tool.turns()) return false;
  const auto newest = std::find_if(ticks.rbegin(), ticks.rend(),
                                   [](const haptics::Tick& tick) { return tick.drilling && tick.removed_mm3 > 0.0; });
  if (newest == ticks.rend()) return false;
  const SightLines lines{
      grid, solid, plan_.soft_tissue, {command.assistant_holds, command.flap_aside}, mirrorDiscOf(second_hand_)};
  return app::worksOutOfSight(lines, *newest, command.tool.head, *eyes_);
}

}  // namespace app
