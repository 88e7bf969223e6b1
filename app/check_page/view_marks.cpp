#include "app/check_page/view_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace app {
namespace {

constexpr Ink kCanal = inkOf(0xfacd3c), kClick = inkOf(0xff6ad5);
constexpr double kNear_mm = 1.5, kHandle_mm = 3.0;

Light lightOf(const CheckMenu& menu, const assets::CanalProposal& canal) {
  const auto row = std::ranges::find_if(menu.rows(), [&canal](const CheckRow& one) {
    return one.kind == CheckRow::Kind::canal && one.is_right == canal.is_right;
  });
  return row != menu.rows().end() ? row->light : Light::open;
}

/// In the page; not finite where the point is not near the slice.
class Placed {
 public:
  explicit Placed(const MarkedView& marked) : marked_(marked), px_(marked.box.size) {}

  glm::dvec2 of(const glm::dvec3& p_P_mm) const { return of(p_P_mm, kNear_mm); }
  glm::dvec2 of(const glm::dvec3& p_P_mm, double near_mm) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (marked_.view == JawView::panoramic) {
      const auto at = marked_.views.inPanoramic(p_P_mm, px_);
      return at ? marked_.box.corner + *at : glm::dvec2(kNone);
    }
    const glm::dvec3 at = marked_.plane.of(p_P_mm);
    const bool is_near = marked_.view == JawView::solid || std::abs(at.z) < near_mm;
    return is_near ? marked_.box.corner + glm::dvec2(at) : glm::dvec2(kNone);
  }
  std::vector<glm::dvec2> of(const std::vector<glm::dvec3>& line_P_mm) const {
    std::vector<glm::dvec2> line;
    for (const glm::dvec3& p : line_P_mm) line.push_back(of(p));
    return line;
  }

 private:
  const MarkedView& marked_;
  glm::ivec2 px_;
};

void drawCanal(const Drawing& page, const MarkedView& marked, const assets::CanalProposal& canal) {
  const Light light = lightOf(marked.menu, canal);
  page.path(Placed(marked).of(canal.line_P_mm), 2.0, light == Light::refused ? page_ink::kRefused : kCanal, false,
            light == Light::confirmed ? Dashes{} : Dashes{6.0, 5.0});
  if (marked.view != JawView::across) return;
  // Where it passes through the slice.
  for (std::size_t p = 1; p < canal.line_P_mm.size(); ++p) {
    const glm::dvec3 a = marked.plane.of(canal.line_P_mm[p - 1]), b = marked.plane.of(canal.line_P_mm[p]);
    if (a.z * b.z <= 0.0 && a.z != b.z)
      page.circle(marked.box.corner + glm::dvec2(glm::mix(a, b, a.z / (a.z - b.z))),
                  canal.radius_mm / marked.plane.pixel_mm, 1.5, kCanal);
  }
}

/// Legible on bone and on air.
void label(const Drawing& page, const std::string& words, const glm::dvec2& at, Align align = Align::centre) {
  for (const glm::dvec2 offset : {glm::dvec2(-1, 0), glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0, 1)})
    page.text(words, at + offset, kPageText_px, page_ink::kRim, align, true);
  page.text(words, at, kPageText_px, page_ink::kWords, align, true);
}

/// At the picture's edges: left, right, top, bottom.
std::array<const char*, 4> directionsOf(const MarkedView& marked) {
  const bool is_right = marked.views.isRight(marked.menu.cursor_P_mm());
  const bool from_behind = marked.view == JawView::solid && std::cos(marked.look.turn_rad) < 0.0;
  switch (marked.view) {
    case JawView::axial:
      return {"R", "L", "A", "P"};
    case JawView::across:
      return {is_right ? "cheek" : "tongue", is_right ? "tongue" : "cheek", "H", "F"};
    case JawView::along:
      return {is_right ? "P" : "A", is_right ? "A" : "P", "H", "F"};
    case JawView::panoramic:
    case JawView::solid:
      return {from_behind ? "L" : "R", from_behind ? "R" : "L", "", ""};
  }
  return {};
}

void scaleBar(const Drawing& page, const glm::dvec2& size, double pixel_mm) {
  const glm::dvec2 to = size - 14.0, from = to - glm::dvec2(10.0 / pixel_mm, 0.0);
  page.line(from, to, 4.0, page_ink::kRim);
  page.line(from, to, 2.0, page_ink::kWords);
  label(page, "10 mm", {from.x - 6.0, from.y}, Align::right);
}

}  // namespace

void drawMarks(const Drawing& page, const MarkedView& marked) {
  const Placed placed(marked);
  const CheckHand& hand = marked.hand;
  for (const assets::CanalProposal& canal : marked.canals) drawCanal(page, marked, canal);
  if (!hand.drawn_P_mm.empty()) page.path(placed.of(hand.drawn_P_mm), 2.0, kClick);
  for (const std::vector<glm::dvec3>& points : hand.canal_points)
    for (const glm::dvec3& p : points) {
      const glm::dvec2 at = placed.of(p, kHandle_mm);
      if (!std::isfinite(at.x)) continue;
      page.disc(at, 6.0, page_ink::kRim);
      page.disc(at, 4.5, kClick);
    }
  if (hand.brush && hand.brush->view == marked.view) {
    const glm::dvec2 at = marked.box.corner + hand.brush->at_px;
    page.circle(at, marked.menu.brush().radius_mm / marked.plane.pixel_mm, 3.0, page_ink::kRim);
    page.circle(at, marked.menu.brush().radius_mm / marked.plane.pixel_mm, 1.5, kClick);
  }
  if (const glm::dvec2 at = placed.of(marked.menu.cursor_P_mm()); std::isfinite(at.x)) {
    page.cross(at, 11.0, 3.0, page_ink::kRim);
    page.cross(at, 10.0, 1.0, page_ink::kAccent);
  }
  for (const glm::dvec3& p : marked.menu.pending())
    if (const glm::dvec2 at = placed.of(p); std::isfinite(at.x)) page.cross(at, 7.0, 2.0, kClick);
}

DrawnKey marksKey(const MarkedView& marked) {
  const CheckHand& hand = marked.hand;
  DrawnKey key;
  key.add(marked.box.size).add(marked.plane.corner_P_mm).add(marked.plane.right_P).add(marked.plane.down_P);
  key.add(marked.menu.cursor_P_mm()).add(marked.menu.pending()).add(hand.drawn_P_mm);
  for (const assets::CanalProposal& canal : marked.canals)
    key.add(lightOf(marked.menu, canal)).add(canal.radius_mm).add(canal.line_P_mm);
  for (const std::vector<glm::dvec3>& points : hand.canal_points) key.add(points);
  const bool has_brush = hand.brush && hand.brush->view == marked.view;
  key.add(has_brush);
  if (has_brush) key.add(hand.brush->at_px).add(marked.menu.brush().radius_mm);
  return key;
}

void drawViewWords(const Drawing& words, const MarkedView& marked) {
  const glm::dvec2 size = marked.box.size, middle = 0.5 * size;
  const std::array<const char*, 4> at = directionsOf(marked);
  label(words, at[0], {8.0, middle.y}, Align::left);
  label(words, at[1], {size.x - 8.0, middle.y}, Align::right);
  label(words, at[2], {middle.x, 12.0});
  label(words, at[3], {middle.x, size.y - 12.0});
  static constexpr std::array<const char*, kJawViews> kNames{"parallel to the bite", "across the arch",
                                                             "along the arch", "panoramic", "teeth and canals"};
  label(words, kNames[static_cast<std::size_t>(marked.view)], {8.0, 12.0}, Align::left);
  if (marked.view != JawView::panoramic) scaleBar(words, size, marked.plane.pixel_mm);
}

DrawnKey viewWordsKey(const MarkedView& marked) {
  DrawnKey key;
  key.add(marked.box.size).add(marked.plane.pixel_mm);
  for (const char* const direction : directionsOf(marked)) key.add(std::string(direction));
  return key;
}

}  // namespace app
