#include "app/check_page/drawn_stroke.h"

#include <algorithm>
#include <array>
#include <utility>

namespace app {
namespace {

/// Points of a stroke: as many as a file may hold, no nearer than a part of its radius.
constexpr std::size_t kMostPoints = 2000;
constexpr double kLeastStep = 0.2;

}  // namespace

assets::CellBox DrawnStroke::show(const std::function<void(const PaintedJaw::Shown&)>& paint) {
  assets::CellBox changed = assets::noCells(ct_.grid.size);
  paint([&](const glm::ivec3& ijk, assets::VoxelLabel now) {
    views_.takeVoxel(ijk, now.label, now.tooth);
    changed.take(ijk);
  });
  return changed;
}

void DrawnStroke::begin(const ViewPlace& place, glm::ivec2 view_px) {
  if (!menu_.mayEdit()) return menu_.say("teeth and canal came with this scan: they can be looked at", true);
  if (!jaw_.isFound()) return menu_.say("the jaw is still being found: the brush works once it is shown", true);
  if (place.view == JawView::solid || place.view == JawView::panoramic)
    return menu_.say("the brush works in the three slices above", true);
  view_ = place.view;
  plane_ = views_.planeOf(place.view, menu_.cursor_P_mm(), page_.look, view_px);
  const glm::dvec3 p_P_mm = plane_->at(place.at_px);
  assets::BrushStroke stroke;
  stroke.radius_mm = menu_.brush().radius_mm;
  stroke.as = menu_.brush().as;
  if (menu_.brush().only_like_here) {
    const std::array<double, 2> range = assets::greyLikeAt({ct_.grid, ct_.hounsfield}, p_P_mm);
    stroke.low_hu = range[0], stroke.high_hu = range[1];
  }
  stroke_ = std::move(stroke);
  dab(p_P_mm);
}

void DrawnStroke::dab(const glm::dvec3& p_P_mm) {
  std::vector<glm::dvec3>& way = stroke_->way_P_mm;
  if (way.size() >= kMostPoints) return;
  if (!way.empty() && glm::distance(way.back(), p_P_mm) < kLeastStep * stroke_->radius_mm) return;
  way.push_back(p_P_mm);
  page_.changed(show([&](const PaintedJaw::Shown& shown) { jaw_.dab(*stroke_, way.size() - 1, shown); }), true);
}

void DrawnStroke::moveTo(const glm::dvec2& at_view_px, glm::ivec2 view_px) {
  if (stroke_) dab(plane_->at(glm::clamp(at_view_px, glm::dvec2(0.0), glm::dvec2(view_px))));
}

bool DrawnStroke::end() {
  if (!stroke_) return false;
  const assets::BrushStroke stroke = *std::exchange(stroke_, std::nullopt);
  const bool is_one = menu_.addStroke(stroke);
  if (is_one) jaw_.endStroke(stroke);
  page_.changed(show([&](const PaintedJaw::Shown& shown) {
    if (!is_one) jaw_.leaveStroke(shown);
  }));
  return is_one;
}

void DrawnStroke::leave() {
  if (!stroke_) return;
  stroke_.reset();
  page_.changed(show([&](const PaintedJaw::Shown& shown) { jaw_.leaveStroke(shown); }));
}

}  // namespace app
