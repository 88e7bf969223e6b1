#include "app/view/still_picture.h"

#include <algorithm>
#include <cmath>

#include "render/quality_ladder.h"

namespace app {
namespace {

template <class A, class B>
bool isAtRest(const calibration::Pose<A, B>& a, const calibration::Pose<A, B>& b) {
  const double half_angle_cos = std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation)));
  return glm::distance(a.translation_mm, b.translation_mm) <= kStill_mm &&
         2.0 * std::acos(half_angle_cos) <= kStill_rad;
}

bool isSameView(const calibration::Rig& a, const calibration::Rig& b) {
  return a.screen.px == b.screen.px && a.screen.lower_left.mm == b.screen.lower_left.mm &&
         a.screen.lower_right.mm == b.screen.lower_right.mm && a.screen.upper_left.mm == b.screen.upper_left.mm &&
         a.left_eye.mm == b.left_eye.mm && a.right_eye.mm == b.right_eye.mm && a.X_WP.rotation == b.X_WP.rotation &&
         a.X_WP.translation_mm == b.X_WP.translation_mm;
}

bool areSameLayers(const render::Layers& a, const render::Layers& b) {
  // A new layer does not compile until it is compared.
  [[maybe_unused]] const auto& [face, gingiva, canal, clearance, cut, ghost, slices, ring, obstacles, clear_tooth, tip,
                                deviation, insertion, paper] = a;
  return a.face_opacity == b.face_opacity && a.gingiva == b.gingiva && a.mandibular_canal == b.mandibular_canal &&
         a.clearance == b.clearance && a.planned_cut == b.planned_cut && a.ghost_tool == b.ghost_tool &&
         a.slices == b.slices && a.gap_ring == b.gap_ring && a.obstacles == b.obstacles &&
         a.clear_tooth == b.clear_tooth && a.tip_inset == b.tip_inset && a.deviation == b.deviation &&
         a.insertion == b.insertion && a.marks == b.marks;
}

// Water drains and blood wells up for seconds after the last motion; less than this is not seen.
bool areSameFields(const render::SurgicalField& a, const render::SurgicalField& b) {
  constexpr double kSeen = 0.1;
  return std::abs(a.water - b.water) < kSeen && std::abs(a.blood - b.blood) < kSeen &&
         std::abs(a.dust - b.dust) < kSeen && std::abs(a.spray - b.spray) < kSeen;
}

// Fog gathers for seconds.
bool areSameGlasses(const std::optional<render::MirrorGlass>& a, const std::optional<render::MirrorGlass>& b) {
  constexpr double kSeen = 0.05;
  if (!a || !b) return a.has_value() == b.has_value();
  return a->out_O == b->out_O && a->radius_mm == b->radius_mm && std::abs(a->fog - b->fog) < kSeen;
}

// Redness fades for seconds.
bool areSameMarks(const render::SoftMarks& a, const render::SoftMarks& b) {
  constexpr double kSeen = 0.1;
  const auto is_same_cut = [](const render::SoftCut& of_a, const render::SoftCut& of_b) {
    return of_a.from_P.mm == of_b.from_P.mm && of_a.to_P.mm == of_b.to_P.mm && of_a.radius_mm == of_b.radius_mm;
  };
  const auto is_alike = [](const render::Reddened& of_a, const render::Reddened& of_b) {
    return std::abs(of_a.share - of_b.share) < kSeen && glm::distance(of_a.place_P.mm, of_b.place_P.mm) < kSeen;
  };
  return std::ranges::equal(a.cuts, b.cuts, is_same_cut) && std::ranges::equal(a.reddened, b.reddened, is_alike);
}

}  // namespace

bool showSameScene(const render::Frame& a, const render::Frame& b) {
  // A new member does not compile until it is compared; quality and display are not the scene's; field,
  // glass and marks have their own comparison.
  [[maybe_unused]] const auto& [rig, display, at_px, swapped, mode, layers, quality, X_PT, X_PT_at_hand, radius, form,
                                length, profile, shaft, angle, gap, ruler, arrow, magnified, slices, curing, tool,
                                shades, handpiece, X_PO, second, glass, pieces, window, site, field, marks, beads,
                                obstacles, flap, gum, flap_serial, gum_serial, paint, paint_serial] = a;
  if (a.mode != b.mode || a.tool_visible != b.tool_visible || a.second_visible != b.second_visible ||
      a.curing.has_value() != b.curing.has_value() || a.tool_shades != b.tool_shades ||
      a.has_handpiece != b.has_handpiece)
    return false;
  if (a.bur_form != b.bur_form || a.bur_radius_mm != b.bur_radius_mm || a.bur_length_mm != b.bur_length_mm ||
      a.bur_profile != b.bur_profile || a.shaft_radius_mm != b.shaft_radius_mm || a.bur_angle_rad != b.bur_angle_rad)
    return false;
  if (a.slices_beside_bur_P_mm != b.slices_beside_bur_P_mm || a.face_window_mm != b.face_window_mm ||
      a.gap.has_value() != b.gap.has_value() || a.ruler != b.ruler || a.arrow != b.arrow || a.beads != b.beads ||
      a.obstacles != b.obstacles || a.site_P.mm != b.site_P.mm || a.flap_serial != b.flap_serial ||
      a.gum_serial != b.gum_serial || a.paint_serial != b.paint_serial)
    return false;
  constexpr double kSameTip_mm = 0.01;
  if (a.magnified.has_value() != b.magnified.has_value() ||
      (a.magnified && (glm::distance(a.magnified->at_P.mm, b.magnified->at_P.mm) > kSameTip_mm ||
                       a.magnified->up_P != b.magnified->up_P || a.magnified->across_mm != b.magnified->across_mm)))
    return false;
  if (a.tool_visible && !isAtRest(a.X_PT, b.X_PT)) return false;
  if (a.tool_visible && a.layers.ghost_tool && !isAtRest(a.X_PT_at_hand, b.X_PT_at_hand)) return false;
  if (a.second_visible && (!isAtRest(a.X_PO, b.X_PO) || a.second_glass.has_value() != b.second_glass.has_value()))
    return false;
  for (std::size_t n = 0; n < a.pieces.size(); ++n)
    if (a.pieces[n].has_value() != b.pieces[n].has_value() || (a.pieces[n] && !isAtRest(*a.pieces[n], *b.pieces[n])))
      return false;
  return areSameLayers(a.layers, b.layers) && isSameView(a.rig, b.rig);
}

FrameDrawing StillPicture::next(const render::Frame& frame, bool changed, Time now) {
  if (changed || !still_ || !showSameScene(*still_, frame)) {
    still_ = frame;
    since_ = now;
    return newest_ = FrameDrawing::live;
  }
  const bool is_refined = newest_ != FrameDrawing::live;
  if (is_refined && areSameFields(still_->field, frame.field) &&
      areSameGlasses(still_->second_glass, frame.second_glass) && areSameMarks(still_->marks, frame.marks))
    return newest_ = FrameDrawing::kept;
  if (!is_refined && now - since_ < kStillFor) return newest_ = FrameDrawing::live;
  still_->field = frame.field;
  still_->marks = frame.marks;
  still_->second_glass = frame.second_glass;
  return newest_ = FrameDrawing::refined;
}

void show(SurgeonDisplay& display, render::Frame frame, FrameDrawing step) {
  if (step != FrameDrawing::live) frame.quality = render::kQualitySteps.front().quality;
  if (step == FrameDrawing::kept)
    display.showAgain(frame);
  else
    display.show(frame);
}

}  // namespace app
