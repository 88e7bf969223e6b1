// Where everything stands on the check page: five views on the right, the list, tools and buttons on the left, a line
// of words below. Whole pixels of the window. Pure; any thread; a few flops.
#pragma once

#include <algorithm>
#include <cstddef>

#include <glm/glm.hpp>

#include "app/check_page/check_menu.h"
#include "app/check_page/jaw_views.h"
#include "app/report/drawing.h"

namespace app {

inline constexpr double kPanelWidth_px = 304.0, kBar_px = 30.0, kTitle_px = 34.0, kPageGap_px = 4.0, kRow_px = 20.0;

namespace page_ink {
inline constexpr Ink kWords = inkOf(0xe6e8ea), kAccent = inkOf(0x57b5e8), kRim = inkOf(0x0e1012),
                     kRefused = inkOf(0xe0533d);
}
inline constexpr double kPageText_px = 13.0;

struct PageBox {
  glm::dvec2 corner{0.0}, size{0.0};
  bool holds(const glm::dvec2& p) const {
    return glm::all(glm::greaterThanEqual(p, corner)) && glm::all(glm::lessThan(p, corner + size));
  }
};

PageBox viewBox(JawView view, glm::ivec2 window_px);
PageBox toolBox(std::size_t tool, glm::ivec2 window_px);
PageBox actionBox(std::size_t action, glm::ivec2 window_px);
/// The n-th that is shown.
PageBox rowBox(std::size_t shown);
std::size_t rowsThatFit(glm::ivec2 window_px);
/// With the selected one among them.
std::size_t firstShownRow(const CheckMenu& menu, glm::ivec2 window_px);

/// What is drawn as one.
enum class PagePart : std::uint8_t { title, list, tools, line };
inline constexpr std::size_t kPageParts = 4;
PageBox partBox(PagePart part, glm::ivec2 window_px);

}  // namespace app
