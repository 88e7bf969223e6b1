#include "app/check_page/page_layout.h"

#include <cmath>

namespace app {
namespace {

constexpr double kButton_px = 26.0, kToolRow_px = 30.0;
/// Of tools, then actions.
constexpr double kToolRows = static_cast<double>(kCheckTools.size() / 2 + 3);

}  // namespace

PageBox viewBox(JawView view, glm::ivec2 window_px) {
  const double left = kPanelWidth_px + kPageGap_px, width = std::max(90.0, window_px.x - left),
               height = std::max(60.0, window_px.y - kTitle_px - kBar_px);
  const double top_height = std::floor(0.54 * height), low_height = height - top_height - kPageGap_px;
  const double axial = std::floor(0.40 * width), slice = std::floor((width - axial) / 2.0) - kPageGap_px;
  const double unrolled = std::floor(0.56 * width);
  switch (view) {
    case JawView::axial:
      return {{left, kTitle_px}, {axial, top_height}};
    case JawView::across:
      return {{left + axial + kPageGap_px, kTitle_px}, {slice, top_height}};
    case JawView::along:
      return {{left + axial + slice + 2.0 * kPageGap_px, kTitle_px}, {slice, top_height}};
    case JawView::panoramic:
      return {{left, kTitle_px + top_height + kPageGap_px}, {unrolled, low_height}};
    case JawView::solid:
      return {{left + unrolled + kPageGap_px, kTitle_px + top_height + kPageGap_px},
              {width - unrolled - kPageGap_px, low_height}};
  }
  return {};
}

PageBox toolBox(std::size_t tool, glm::ivec2 window_px) {
  const double width = 0.5 * (kPanelWidth_px - 3.0 * kPageGap_px);
  const double top = window_px.y - kBar_px - kToolRow_px * kToolRows + kToolRow_px * static_cast<double>(tool / 2);
  return {{kPageGap_px + static_cast<double>(tool % 2) * (width + kPageGap_px), top}, {width, kButton_px}};
}

/// Confirm and refuse, undo and redo, save and what is said of the pictures.
PageBox actionBox(std::size_t action, glm::ivec2 window_px) { return toolBox(kCheckTools.size() + action, window_px); }

PageBox rowBox(std::size_t shown) {
  return {{kPageGap_px, kTitle_px + kRow_px * static_cast<double>(shown)},
          {kPanelWidth_px - 2.0 * kPageGap_px, kRow_px}};
}

std::size_t rowsThatFit(glm::ivec2 window_px) {
  return static_cast<std::size_t>(std::max(1.0, (toolBox(0, window_px).corner.y - kTitle_px - kPageGap_px) / kRow_px));
}

std::size_t firstShownRow(const CheckMenu& menu, glm::ivec2 window_px) {
  const std::size_t fit = rowsThatFit(window_px), count = menu.rows().size();
  if (count <= fit) return 0;
  return std::min(menu.selected() > fit / 2 ? menu.selected() - fit / 2 : 0, count - fit);
}

PageBox partBox(PagePart part, glm::ivec2 window_px) {
  const double tools = toolBox(0, window_px).corner.y, line = window_px.y - kBar_px;
  switch (part) {
    case PagePart::title:
      return {{0.0, 0.0}, {window_px.x, kTitle_px}};
    case PagePart::list:
      return {{0.0, kTitle_px}, {kPanelWidth_px, tools - kTitle_px}};
    case PagePart::tools:
      return {{0.0, tools}, {kPanelWidth_px, line - tools}};
    case PagePart::line:
      return {{0.0, line}, {window_px.x, kBar_px}};
  }
  return {};
}

}  // namespace app
