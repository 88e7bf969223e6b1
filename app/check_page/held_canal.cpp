#include "app/check_page/held_canal.h"

#include <cmath>
#include <utility>

namespace app {
namespace {

constexpr double kPoint_px = 9.0, kLine_px = 6.0, kPointOff_mm = 3.0, kLineOff_mm = 1.5;

bool isNear(const glm::dvec3& in_view, const glm::dvec2& at_px, double reach_px, double off_mm) {
  return std::isfinite(in_view.x) && std::abs(in_view.z) <= off_mm &&
         glm::distance(glm::dvec2(in_view), at_px) <= reach_px;
}

}  // namespace

std::array<std::vector<glm::dvec3>, 2> HeldCanal::points(const std::vector<assets::CanalProposal>& canals) const {
  std::array<std::vector<glm::dvec3>, 2> points;
  for (const assets::CanalProposal& canal : canals) {
    std::vector<glm::dvec3>& of_side = points[canal.is_right ? 0 : 1];
    if (const CanalClicks* const clicked = menu_.edits().canalOn(canal.is_right))
      of_side = clicked->at_P_mm;
    else
      of_side = {canal.line_P_mm.front(), canal.line_P_mm.back()};
  }
  return points;
}

std::optional<HeldCanal::Held> HeldCanal::pointAt(const std::vector<assets::CanalProposal>& canals,
                                                  const glm::dvec2& at_px, const InView& in_view) const {
  const auto points_of = points(canals);
  for (const bool is_right : {true, false}) {
    const std::vector<glm::dvec3>& points_P_mm = points_of[is_right ? 0 : 1];
    for (std::size_t n = 0; n < points_P_mm.size(); ++n) {
      const glm::dvec3 at = in_view(points_P_mm[n]);
      if (isNear(at, at_px, kPoint_px, kPointOff_mm))
        return Held{is_right, points_P_mm, n, at.z, false, menu_.edits().canalOn(is_right) != nullptr};
    }
  }
  return std::nullopt;
}

bool HeldCanal::press(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px,
                      const InView& in_view) {
  if (!menu_.mayEdit() || !menu_.pending().empty()) return false;
  line_P_mm_.clear();
  held_ = pointAt(canals, at_px, in_view);
  if (held_) return true;
  // One more point, where the line is pressed.
  for (const assets::CanalProposal& canal : canals)
    for (const glm::dvec3& p : canal.line_P_mm) {
      const glm::dvec3 at = in_view(p);
      if (!isNear(at, at_px, kLine_px, kLineOff_mm)) continue;
      Held held{canal.is_right, points(canals)[canal.is_right ? 0 : 1], 0, at.z, false};
      // Points lie on the line in its order, whichever end was clicked first.
      held.which = placeInWay(held.points_P_mm, p);
      held.points_P_mm.insert(held.points_P_mm.begin() + static_cast<std::ptrdiff_t>(held.which), p);
      held_ = std::move(held);
      return true;
    }
  return false;
}

void HeldCanal::moveTo(const glm::dvec3& p_P_mm, const glm::dvec3& normal_P) {
  if (!held_) return;
  held_->points_P_mm[held_->which] = p_P_mm + held_->off_mm * normal_P;
  held_->is_moved = true;
  const assets::HalfJaw& half = halves_[held_->is_right ? 0 : 1];
  line_P_mm_ = assets::quickCanal(half, held_->points_P_mm);
  // Off the bone: how the points lie.
  if (line_P_mm_.empty()) line_P_mm_ = held_->points_P_mm;
}

bool HeldCanal::release() {
  const std::optional<Held> held = std::exchange(held_, std::nullopt);
  line_P_mm_.clear();
  if (!held) return false;
  if (!held->is_moved) {
    if (held->is_clicked) return menu_.say("a point of the canal: drag it, or Delete removes it", false), false;
    const std::size_t before = menu_.edits().done();
    menu_.clickAt(held->points_P_mm[held->which], held->is_right);
    return menu_.edits().done() != before;
  }
  menu_.moveCursor(held->points_P_mm[held->which]);
  menu_.addCanal({held->is_right, held->points_P_mm});
  return true;
}

std::optional<glm::dvec3> HeldCanal::proposedEndAt(const std::vector<assets::CanalProposal>& canals,
                                                   const glm::dvec2& at_px, const InView& in_view) const {
  const auto found = pointAt(canals, at_px, in_view);
  return found && !found->is_clicked ? std::optional(found->points_P_mm[found->which]) : std::nullopt;
}

bool HeldCanal::removeAt(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px,
                         const InView& in_view) {
  const auto found = pointAt(canals, at_px, in_view);
  if (!found || !menu_.mayEdit()) return false;
  std::vector<glm::dvec3> points_P_mm = found->points_P_mm;
  points_P_mm.erase(points_P_mm.begin() + static_cast<std::ptrdiff_t>(found->which));
  menu_.addCanal({found->is_right, std::move(points_P_mm)});
  return true;
}

}  // namespace app
