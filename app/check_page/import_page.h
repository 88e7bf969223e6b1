// What a window shows while a scan is imported, or a patient opened: the stages with bars and seconds, what is done of
// the whole, a button that cancels, and beside them slices of the scan (import_view.h). One layout for drawing and
// clicking. Nothing of the scan's own names is shown. Pure; any one thread; some milliseconds a picture.
#pragma once

#include <array>
#include <string>

#include <glm/glm.hpp>

#include "app/check_page/import_stages.h"
#include "render/image.h"

namespace app {

struct ImportPageText {
  std::string title;
  std::string about;     ///< a line below
  bool may_stop = true;  ///< with a button, and room for slices
};

/// Axial, coronal and sagittal slice; empty where the window has no room for them.
struct ImportViewBox {
  glm::ivec2 corner_px{0}, size_px{0};
};
std::array<ImportViewBox, 3> importViewBoxes(glm::ivec2 window_px);

/// `at_s`: of the clock of the stages. `slices`: of importViewBoxes(); null: not yet.
render::Image importPage(const ImportStages& stages, double at_s, const ImportPageText& text, glm::ivec2 window_px,
                         const std::array<render::Image, 3>* slices = nullptr);

/// Whether the button that cancels lies there.
bool isCancelAt(const glm::dvec2& at_px, glm::ivec2 window_px);

}  // namespace app
