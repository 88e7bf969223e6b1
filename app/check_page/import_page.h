// What a window shows while a scan is imported, or a patient opened: the stages with bars and seconds, what is done of
// the whole, and a button that cancels. One layout for drawing and clicking. Nothing of the scan's own names is shown.
// Pure; any one thread; some milliseconds a picture.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "app/check_page/import_stages.h"
#include "render/image.h"

namespace app {

struct ImportPageText {
  std::string title;
  std::string about;     ///< a line below
  bool may_stop = true;  ///< with a button
};

/// `at_s`: of the clock of the stages.
render::Image importPage(const ImportStages& stages, double at_s, const ImportPageText& text, glm::ivec2 window_px);

/// Whether the button that cancels lies there.
bool isCancelAt(const glm::dvec2& at_px, glm::ivec2 window_px);

}  // namespace app
