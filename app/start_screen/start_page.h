// The start screen as a picture and as places to click: one layout for both, in units of which the page has 160 by 100
// in its middle. Pure; any one thread; some milliseconds a picture.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "app/start_screen/start_menu.h"
#include "render/image.h"

namespace app {

/// A choice, or the button that starts.
struct StartPlace {
  std::size_t list = 0, choice = 0;
  bool starts = false;
  glm::dvec2 corner{0.0}, size{0.0};  ///< units from the page's upper left
};

inline constexpr glm::dvec2 kStartPage{160.0, 100.0};

/// What is shown of long lists is around the choice.
std::vector<StartPlace> startPlaces(const StartMenu& menu);

/// The place at a pixel of a window of that size.
std::optional<StartPlace> startPlaceAt(const StartMenu& menu, const glm::dvec2& at_px, glm::ivec2 window_px);

render::Image startPage(const StartMenu& menu, glm::ivec2 window_px);

}  // namespace app
