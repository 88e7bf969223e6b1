// Mouse and keys for the instrument of the second hand (--second-hand mouse), as HandInput has them for the first:
// while O is held, or always where another device moves the first. Drag: in the plane of the screen; wheel: in depth;
// arrows, Q, E: tilt and turn. Everything else stays with the first hand. Frame W of the first view, mm. Main thread.
#pragma once

#include "app/controls/hand_input.h"

namespace app {

class OtherHandInput {
 public:
  using Pose = calibration::Pose<calibration::World, calibration::OtherTool>;

  /// `has_mouse`: the mouse is its alone.
  OtherHandInput(const Pose& X_WO, bool has_mouse)
      : hand_({X_WO.rotation, X_WO.translation_mm}), has_mouse_(has_mouse) {}

  /// As HandInput.
  void setView(const glm::dquat& rotation) { hand_.setView(rotation); }
  /// Whether it is for this hand; else it is for the first.
  bool take(const render::WindowEvent& event, double mm_per_px);
  Pose X_WO() const { return {hand_.X_WT().rotation, hand_.X_WT().translation_mm}; }

 private:
  bool moves(const render::WindowEvent& event) const;

  HandInput hand_;
  bool has_mouse_, held_ = false;
};

}  // namespace app
