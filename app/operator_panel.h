// What the operator's window says and asks, drawn with Dear ImGui (inside): the state of drill and recording first,
// then tool, law, picture, servo, layers, keys. Leaves a place free for what the surgeon sees. Knows no window and no
// OpenGL. Main thread; well under a millisecond.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "app/rehearsal_status.h"

namespace app {

/// What the operator asked for since the last drawing.
struct OperatorWishes {
  bool snapshot = false, drill_switch = false, arm_again = false, stop_motors = false, end = false;
  std::optional<haptics::LawKind> law;
  std::optional<render::Layers> layers;
};

/// Loads the fonts; once, after ImGui's context was made.
void styleOperatorPanel();

/// Where what the surgeon sees goes, in a window of this size: the largest place of its shape beside the panel. Px from
/// the top left.
struct PicturePlace {
  glm::ivec2 corner_px{0}, size_px{0};
};
PicturePlace picturePlace(glm::ivec2 window_px, glm::ivec2 picture_px);

/// Between ImGui's NewFrame and Render.
OperatorWishes drawOperatorPanel(const RehearsalStatus& status, glm::ivec2 window_px, glm::ivec2 picture_px);

}  // namespace app
