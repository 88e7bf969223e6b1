// What the check page draws over a view's picture: canals, points of a canal, the brush, the cursor, clicks that wait
// for another; then directions, name and a bar of 10 mm. Main thread; 0.3 ms a view, its words 2 ms.
#pragma once

#include <optional>
#include <vector>

#include "app/check_page/check_menu.h"
#include "app/check_page/drawn_key.h"
#include "app/check_page/jaw_views.h"
#include "app/check_page/page_layout.h"
#include "app/report/drawing.h"

namespace app {

struct ViewPlace {
  JawView view = JawView::axial;
  glm::dvec2 at_px{0.0};  ///< in the view
};

/// What lies under the hand, besides the cursor.
struct CheckHand {
  std::optional<ViewPlace> brush{};                   ///< where its circle is
  std::vector<std::vector<glm::dvec3>> canal_points;  ///< to be taken hold of
  std::vector<glm::dvec3> drawn_P_mm;                 ///< the canal as it would lead now
};

/// All of it outlives the mark's drawing.
struct MarkedView {
  JawView view = JawView::axial;
  PageBox box;
  JawViews::Plane plane;
  const JawViews& views;
  const CheckMenu& menu;
  const std::vector<assets::CanalProposal>& canals;  ///< of what was found
  const CheckHand& hand;
  SolidLook look;
};

void drawMarks(const Drawing& page, const MarkedView& marked);
DrawnKey marksKey(const MarkedView& marked);

/// Directions, name and bar, on a drawing of the view's size.
void drawViewWords(const Drawing& words, const MarkedView& marked);
DrawnKey viewWordsKey(const MarkedView& marked);

}  // namespace app
