// What the instructor's window says and asks, drawn with Dear ImGui (inside): the state of drill and recording first,
// then tool, law, picture, servo, layers, keys. Leaves a place free for what the surgeon sees. Knows no window and no
// OpenGL. Main thread; well under a millisecond.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "app/controls/control.h"
#include "app/instructor/rehearsal_status.h"

namespace app {

/// Dear ImGui's context with fonts and colours, for one panel; one at a time.
class PanelContext {
 public:
  PanelContext();
  ~PanelContext();
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
};

/// Where what the surgeon sees goes, in a window of this size: the largest place of its shape beside the panel. Px from
/// the top left.
struct ImageArea {
  glm::ivec2 corner_px{0}, size_px{0};
};
ImageArea imageArea(glm::ivec2 window_px, glm::ivec2 picture_px);

/// What was asked for since the last drawing. Between ImGui's NewFrame and Render.
std::vector<ControlRequest> drawInstructorPanel(const RehearsalStatus& status, glm::ivec2 window_px,
                                                glm::ivec2 picture_px);

}  // namespace app
