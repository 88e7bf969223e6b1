// The panel of the instructor's window, drawn with Dear ImGui: state of drill and recording, hand, tool, law, view,
// servo, layers, keys. It leaves an area free for the surgeon's image. Independent of window and OpenGL. Main thread;
// well under a millisecond.
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

/// Area of an image in a window. Px from the top left.
struct ImageArea {
  glm::ivec2 corner_px{0}, size_px{0};
};
/// The surgeon's image in a window of this size: the largest of its shape next to the panel and above the panoramic
/// view.
ImageArea imageArea(glm::ivec2 window_px, glm::ivec2 surgeon_px);
/// The panoramic view: the largest of its shape below the keys.
ImageArea panoramicArea(glm::ivec2 window_px, glm::ivec2 surgeon_px, glm::ivec2 panoramic_px);

/// Returns the requests since the last drawing. Between ImGui's NewFrame and Render.
std::vector<ControlRequest> drawInstructorPanel(const RehearsalStatus& status, glm::ivec2 window_px,
                                                glm::ivec2 surgeon_px);

}  // namespace app
