// A stroke of the brush under the hand: from a press in a slice to the release, shown dab by dab while it is drawn, one
// edit when it ends. Frame P, mm. Main thread; a dab of 1.5 mm 0.1 ms at 0.35 mm.
#pragma once

#include <functional>
#include <optional>

#include "app/check_page/check_menu.h"
#include "app/check_page/check_page.h"
#include "app/check_page/painted_jaw.h"

namespace app {

class DrawnStroke {
 public:
  /// All of them outlive it.
  DrawnStroke(CheckMenu& menu, PaintedJaw& jaw, JawViews& views, CheckPage& page, const assets::CtVolume& ct)
      : menu_(menu), jaw_(jaw), views_(views), page_(page), ct_(ct) {}

  bool isDrawn() const { return stroke_.has_value(); }
  /// In a slice, with the brush in hand; says why where it cannot begin.
  void begin(const ViewPlace& place, glm::ivec2 view_px);
  void moveTo(const glm::dvec2& at_view_px, glm::ivec2 view_px);
  /// True: it is an edit now.
  bool end();
  void leave();

 private:
  void dab(const glm::dvec3& p_P_mm);
  /// What `paint` changes goes into the views; around it.
  assets::CellBox show(const std::function<void(const PaintedJaw::Shown&)>& paint);

  CheckMenu& menu_;
  PaintedJaw& jaw_;
  JawViews& views_;
  CheckPage& page_;
  const assets::CtVolume& ct_;
  JawView view_ = JawView::axial;
  std::optional<JawViews::Plane> plane_;  ///< of the slice as it began
  std::optional<assets::BrushStroke> stroke_;
};

}  // namespace app
