#include "app/calibrate/page_scene.h"

#include <algorithm>
#include <cmath>

#include "app/calibrate/page_inks.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using calibration::Point;
using calibration::TargetKind;
using calibration::World;
using render::Eye;

constexpr double kCueLength_mm = 70.0, kDash_mm = 5.0, kGap_mm = 6.0;
constexpr double kRing_mm = 15.0, kRingWidth_mm = 3.0;

/// Projection of W onto the page for one eye.
struct Sight {
  const ScreenPage& page;
  const calibration::Rig& rig;
  Eye eye;

  glm::dvec2 at(const glm::dvec3& p_W) const { return page.seenAt(rig, eye, Point<World>{p_W}); }
  /// Length on the page of 1 mm across the line of sight.
  double scaleAt(const glm::dvec3& p_W) const {
    const glm::dvec3 across = glm::normalize(rig.right_eye.mm - rig.left_eye.mm);
    return glm::length(at(p_W + across) - at(p_W));
  }
  void line(const glm::dvec3& from_W, const glm::dvec3& to_W, double width_mm, const Ink& ink) const {
    page.path({at(from_W), at(to_W)}, width_mm * scaleAt(0.5 * (from_W + to_W)), ink);
  }
};

void drawCross(const Sight& sight, glm::dvec2 p, double arm_mm, double width_mm, const Ink& ink) {
  sight.page.line(p - glm::dvec2(arm_mm, 0.0), p + glm::dvec2(arm_mm, 0.0), width_mm, ink);
  sight.page.line(p - glm::dvec2(0.0, arm_mm), p + glm::dvec2(0.0, arm_mm), width_mm, ink);
}

/// A cone that opens towards the eye, with its apex at the target.
void drawPit(const Sight& sight, const glm::dvec3& position_W, double radius_mm, double width_mm, const Ink& ink) {
  const glm::dvec3 out = glm::normalize(sight.rig.cyclopeanEye().mm - position_W);
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), out)), y = glm::cross(out, x);
  std::vector<glm::dvec2> rim;
  constexpr int kSides = 32;
  for (int n = 0; n < kSides; ++n) {
    const double turn = 2.0 * calibration::kPi * n / kSides;
    rim.push_back(sight.at(position_W + radius_mm * (out + std::cos(turn) * x + std::sin(turn) * y)));
  }
  sight.page.path(rim, width_mm, ink, true);
  for (int n = kSides / 8; n < kSides; n += kSides / 4)
    sight.page.path({sight.at(position_W), rim[static_cast<std::size_t>(n)]}, 0.6 * width_mm, ink);
}

void drawMarker(const Sight& sight, const WizardView& view, const ShownTarget& target, glm::dvec2 p, double s,
                const Ink& ink, bool is_next) {
  const double size = is_next ? 1.0 : 0.45;
  if (view.target_kind == TargetKind::cross) return drawCross(sight, p, 11.0 * size * s, is_next ? 0.7 : 0.5, ink);
  if (view.target_kind == TargetKind::pit && !view.zero_parallax)
    return drawPit(sight, target.position_W.mm, 5.0 * size, 0.9 * size * s, ink);
  sight.page.circle(p, 5.0 * size * s, 0.9 * size * s, ink);
  sight.page.disc(p, 0.8 * s, ink);
}

void drawTarget(const Sight& sight, const WizardView& view, const ShownTarget& target, double glow) {
  const glm::dvec2 p = sight.at(target.position_W.mm);
  const double s = sight.scaleAt(target.position_W.mm);
  const Ink done = dimmed(kGoodInk, 0.6);
  switch (target.state) {
    case TargetState::pending:
      return drawMarker(sight, view, target, p, s, kPendingInk, false);
    case TargetState::done:
      sight.page.disc(p, 1.2 * s, done);
      sight.page.path({p + s * glm::dvec2(-4.0, -6.5), p + s * glm::dvec2(-1.5, -4.0), p + s * glm::dvec2(3.5, -10.0)},
                      0.9 * s, done);
      return;
    case TargetState::doubtful:
      sight.page.path({p + s * glm::dvec2(0.0, -5.0), p + s * glm::dvec2(5.0, 0.0), p + s * glm::dvec2(0.0, 5.0),
                       p + s * glm::dvec2(-5.0, 0.0)},
                      1.0 * s, kDoubtInk, true);
      sight.page.disc(p, 1.2 * s, kDoubtInk);
      return;
    case TargetState::next:
      break;
  }
  // Brighter towards the centre.
  for (const double ring : {11.0, 9.0, 7.0})
    sight.page.circle(p, ring * s, 1.0 * s, dimmed(kWantedInk, (0.15 + 0.35 * glow) * (12.5 - ring) / 5.5));
  drawMarker(sight, view, target, p, s, kWordInk, true);
}

/// Wanted direction dashed, present one solid, both from the target.
void drawTilt(const Sight& sight, const glm::dvec3& from_W, const TiltCue& tilt) {
  const glm::dvec3 wanted = tilt.wanted_W.xyz, present = tilt.present_W.xyz;
  const Ink ink = tilt.met ? kGoodInk : kWantedInk;
  for (double a = 4.0; a < kCueLength_mm; a += kDash_mm + kGap_mm)
    sight.line(from_W + a * wanted, from_W + std::min(a + kDash_mm, kCueLength_mm) * wanted, 2.4, ink);
  const glm::dvec3 end = from_W + kCueLength_mm * wanted;
  const glm::dvec2 p = sight.at(end);
  const double s = sight.scaleAt(end);
  sight.page.circle(p, 6.0 * s, 1.2 * s, ink);
  if (tilt.met)
    sight.page.path({p + s * glm::dvec2(-3.0, 0.0), p + s * glm::dvec2(-0.5, 2.5), p + s * glm::dvec2(3.5, -3.0)},
                    1.4 * s, ink);
  const glm::dvec3 is = from_W + kCueLength_mm * present;
  sight.line(from_W + 4.0 * present, is, 1.4, kPresentInk);
  sight.page.disc(sight.at(is), 2.5 * sight.scaleAt(is), kPresentInk);
}

void drawCapture(const Sight& sight, glm::dvec2 p, double s, double share) {
  if (share <= 0.0) return;
  sight.page.circle(p, kRing_mm * s, kRingWidth_mm * s, kFaintInk);
  sight.page.arc(p, kRing_mm * s, share, kRingWidth_mm * s, share < 1.0 ? kPresentInk : kGoodInk);
}

/// Tip ball, cone, shaft.
void drawStylus(const Sight& sight, const TrueStylus& stylus) {
  const glm::dvec3 tip = stylus.tip_W.mm, along = stylus.along_W.xyz;
  struct Girth {
    double from_tip_mm, radius_mm;
  };
  constexpr Girth kGirths[] = {{0.5, 0.8}, {12.0, 1.2}, {30.0, 4.0}, {110.0, 4.5}};
  std::vector<glm::dvec2> left, right;
  const glm::dvec2 axis = sight.at(tip + 30.0 * along) - sight.at(tip);
  const double long_mm = glm::length(axis);
  const glm::dvec2 side = long_mm > 1e-6 ? glm::dvec2(-axis.y, axis.x) / long_mm : glm::dvec2(1.0, 0.0);
  for (const Girth& girth : kGirths) {
    const glm::dvec3 p = tip + girth.from_tip_mm * along;
    const double r = girth.radius_mm * sight.scaleAt(p);
    left.push_back(sight.at(p) + r * side);
    right.push_back(sight.at(p) - r * side);
  }
  std::vector<glm::dvec2> outline = left;
  outline.insert(outline.end(), right.rbegin(), right.rend());
  // An outline only: text and targets behind it stay readable.
  sight.page.path(outline, 0.7, kQuietInk, true);
  const double s = sight.scaleAt(tip);
  sight.page.disc(sight.at(tip), 1.3 * s, {0.85, 0.85, 0.85});
  sight.page.circle(sight.at(tip), 1.3 * s, 0.25, kGroundInk);
}

}  // namespace

void drawScene(const ScreenPage& page, const calibration::Rig& rig, Eye eye, const WizardView& view,
               const std::optional<TrueStylus>& stylus, double glow) {
  if (!view.numbers.empty()) return;
  const Sight sight{page, rig, eye}, flat{page, rig, Eye::cyclopean};
  const Sight& targets = view.zero_parallax ? flat : sight;
  const ShownTarget* next = nullptr;
  for (const ShownTarget& target : view.targets) {
    if (target.state == TargetState::next) next = &target;
    if (target.state != TargetState::next) drawTarget(targets, view, target, glow);
  }
  if (next != nullptr) {
    const glm::dvec2 p = targets.at(next->position_W.mm);
    drawCapture(targets, p, targets.scaleAt(next->position_W.mm), view.capture);
    drawTarget(targets, view, *next, glow);
    if (view.tilt) drawTilt(sight, next->position_W.mm, *view.tilt);
  } else if (view.capture > 0.0) {
    drawCapture(flat, {0.0, 0.0}, 1.0, view.capture);
  }
  if (stylus) drawStylus(sight, *stylus);
  if (view.tip_W) {
    const double s = sight.scaleAt(view.tip_W->mm);
    page.circle(sight.at(view.tip_W->mm), 2.2 * s, 0.6 * s, kPresentInk);
  }
}

}  // namespace app
