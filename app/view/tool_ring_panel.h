// The ring of instruments (HeadUpRing) as one panel of the head-up text: names around the place, the one in the hand
// outlined, the chosen one light, with the sector that chooses it. Inside the screen, smaller where that is narrow.
// Viewer's pixels. Any one thread; laid out in 0.1 ms, drawn in some ms when another one is chosen.
#pragma once

#include <functional>
#include <string>

#include "app/view/head_up_line.h"

namespace app {

struct ToolRingPanel {
  std::string content;  ///< as text; an equal one is not drawn again
  glm::ivec2 corner_px{0}, size_px{1};
  std::function<void(const Drawing&)> draw;
};

/// `ring` has names; `text_px`: height of its letters.
ToolRingPanel toolRingPanel(const HeadUpRing& ring, const HeadUpPlace& place, double text_px);

}  // namespace app
