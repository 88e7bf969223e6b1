#include "app/rehearsal/frame_builder.h"

#include <algorithm>
#include <cmath>

#include "app/options/picture_option.h"
#include "calibration/geometry/units.h"
#include "haptics/bone/cure.h"

namespace app {
namespace {

constexpr double kDrawnBurRevolutions_per_s = 7.0;  ///< as drawn; a real bur is too fast to display

/// As the servo has it shine (bone/cure).
std::optional<render::CuringSpot> curingLight(const haptics::Tick& tick, const haptics::Tool& tool) {
  if (!tick.filling.works || tool.hand_instrument != haptics::HandInstrument::curing_lamp) return {};
  const glm::dvec3 axis_P = tick.heldRotation() * glm::dvec3(0.0, 0.0, -1.0);
  const auto kind = static_cast<std::size_t>(tool.hand_instrument);
  const double tip_mm = haptics::kHandInstrumentSizes[kind].tip_radius_mm;
  return render::CuringSpot{
      {tick.proxy_P.mm + tip_mm * axis_P}, axis_P, haptics::kLampRadius_mm, haptics::kLampReach_mm};
}

}  // namespace

render::Frame openingFrame(const RehearsalPlan& plan) {
  render::Frame frame = plan.first_frame;
  frame.rig = plan.rig;
  frame.face_window_mm = plan.face_window_mm;
  frame.site_P = {plan.patient.focus_P_mm()};
  frame.X_PT.translation_mm = frame.site_P.mm;
  frame.field = surgicalField(openingClarity(plan));
  return nextFrame(frame, {}, plan.command);
}

render::Frame nextFrame(const render::Frame& before, const haptics::Tick& tick, const haptics::Command& command) {
  render::Frame frame = before;
  frame.tool_shades = command.tool.turns();
  frame.has_handpiece = command.tool.handpiece;
  const haptics::BurShape& head = command.tool.head;
  frame.bur_radius_mm = head.radius_mm;
  frame.bur_length_mm = head.length_mm;
  frame.shaft_radius_mm = command.tool.shaft.radius_mm;
  frame.bur_form = static_cast<assets::BurForm>(head.kind);
  frame.bur_profile = head.profile;
  frame.curing = curingLight(tick, command.tool);
  frame.tool_visible = tick.dt_s > 0.0;
  if (!frame.tool_visible) return frame;
  if (!haptics::has(tick.faults, haptics::Fault::bad_pose)) frame.X_PT.rotation = tick.heldRotation();
  frame.X_PT.translation_mm = tick.proxy_P.mm;
  frame.X_PT_at_hand = {glm::conjugate(tick.soft.turn_P) * frame.X_PT.rotation, tick.hand.X_PT.translation_mm};
  if (tick.drilling) {
    frame.bur_angle_rad = std::fmod(tick.t_s * kDrawnBurRevolutions_per_s, 1.0) * 2.0 * calibration::kPi;
    frame.slices_beside_bur_P_mm = {};
  }
  return frame;
}

render::MovedPieces movedPieces(const haptics::Tick& tick) {
  static_assert(haptics::kMaxPieces == render::kMostPieces);
  render::MovedPieces moved;
  for (std::size_t n = 0; n < tick.pieces; ++n)
    if (!haptics::Bodies::isRest(tick.X_PQ[n])) moved[n] = tick.X_PQ[n];
  return moved;
}

render::Frame closingFrame(const render::Frame& last, const haptics::Tick& tick, bool is_moved_by_a_person) {
  render::Frame frame = last;
  frame.tool_visible =
      frame.tool_visible && (is_moved_by_a_person || tick.depth_mm > 0.0 || tick.file.stay == haptics::FileStay::wall);
  return frame;
}

glm::dvec3 scrolledSlices(const render::Frame& frame, render::SlicePlane plane, double steps) {
  constexpr double kStep_mm = 0.5, kFarthest_mm = 15.0;
  const int axis = plane == render::SlicePlane::axial ? 2 : plane == render::SlicePlane::coronal ? 1 : 0;
  glm::dvec3 beside_mm = frame.slices_beside_bur_P_mm;
  beside_mm[axis] = std::clamp(beside_mm[axis] + kStep_mm * steps, -kFarthest_mm, kFarthest_mm);
  return beside_mm;
}

FieldClarity openingClarity(const RehearsalPlan& plan) {
  return FieldClarity({plan.cut ? plan.cut->surface_P_mm : plan.patient.focus_P_mm()});
}

render::SurgicalField surgicalField(const FieldClarity& clarity) {
  const FieldCover& cover = clarity.cover();
  return {clarity.centre_P(), clarity.reach_mm(), cover.water, cover.blood, cover.dust, cover.spray};
}

render::Layers layersAfter(const render::Layers& before, const ControlRequest& request) {
  render::Layers layers = before;
  if (request.control == Control::layer) {
    bool& shown = layers.*kPictureLayers[static_cast<std::size_t>(request.value)].on;
    shown = !shown;
  }
  if (request.control == Control::clear_tooth)
    layers.clear_tooth = request.value == kNoValue ? !layers.clear_tooth : request.value != 0;
  const auto switched = [&](bool shown) { return request.value == kNoValue ? !shown : request.value != 0; };
  if (request.control == Control::deviation) layers.deviation = switched(layers.deviation);
  if (request.control == Control::insertion) layers.insertion = switched(layers.insertion);
  if (request.control == Control::face) layers.face_opacity = static_cast<float>(request.value) / 100.0f;
  return layers;
}

}  // namespace app
