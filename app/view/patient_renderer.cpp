#include "app/view/patient_renderer.h"

#include <algorithm>
#include <vector>

#include "assets/instrument/canal_file.h"
#include "assets/instrument/elevator.h"
#include "assets/instrument/forceps.h"
#include "assets/instrument/hand_instrument.h"
#include "assets/instrument/handpiece.h"

namespace app {
namespace {

assets::HandpieceParameters drawnAs(const haptics::Tool& tool) {
  assets::HandpieceParameters drawn;
  drawn.form = static_cast<assets::BurForm>(tool.head.kind);
  drawn.bur_radius_mm = tool.head.radius_mm;
  drawn.bur_length_mm = tool.head.length_mm;
  drawn.profile = tool.head.profile;
  drawn.neck_radius_mm = tool.shaft.radius_mm;
  drawn.handpiece = tool.handpiece;
  return drawn;
}
static_assert(static_cast<int>(assets::BurForm::revolved) == static_cast<int>(haptics::ShapeKind::revolved));

assets::ElevatorForm formOf(haptics::ElevatorKind kind) {
  return static_cast<assets::ElevatorForm>(static_cast<int>(kind) - 1);
}
static_assert(static_cast<int>(assets::ElevatorForm::cryer_right) + 1 ==
              static_cast<int>(haptics::ElevatorKind::cryer_right));

assets::HandInstrumentForm formOf(haptics::HandInstrument kind) {
  return static_cast<assets::HandInstrumentForm>(static_cast<int>(kind) - 1);
}
static_assert(static_cast<int>(assets::HandInstrumentForm::root_plugger) + 1 ==
              static_cast<int>(haptics::HandInstrument::root_plugger));

/// A little wider than what they grip (haptics::forcepsTool).
constexpr double kOpenBeaks_mm = 8.0;

}  // namespace

render::Guides guidesFor(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut) {
  return {patient.mandibular_canal_P_mm, patient.mandibular_canal_radius_mm, cut};
}

std::unique_ptr<render::FrameRenderer> patientRenderer(const assets::Patient& patient, const haptics::Tool& tool,
                                                       const std::optional<assets::PlannedCut>& cut,
                                                       std::span<const std::uint8_t> solid,
                                                       const render::RenderOptions& options) {
  auto renderer = std::make_unique<render::FrameRenderer>(patient.ct.grid, solid, patient.ct.label, options);
  renderer->setFace(patient.face);
  renderer->setGingiva(patient.gingiva);
  renderer->setGuides(guidesFor(patient, cut));
  renderer->setScan(
      {patient.ct.hounsfield, patient.ct.solid, patient.mandibular_canal_P_mm, patient.mandibular_canal_radius_mm});
  showInstrument(*renderer, tool);
  if (!patient.fragments.empty()) showFragments(*renderer, patient.fragments);
  return renderer;
}

void showInstrument(render::FrameRenderer& renderer, const haptics::Tool& tool) {
  if (tool.grips) return showForceps(renderer, kOpenBeaks_mm);
  if (const auto file = tool.file.made())
    return renderer.setInstrument(
        assets::canalFile({.file = *file, .node_T_mm = {}, .torque_share = {}, .stop_mm = tool.file.stop_mm}));
  if (const auto cone = tool.file.cone())
    return renderer.setInstrument(assets::canalCone({.cone = *cone, .node_T_mm = {}, .is_held = true}));
  if (tool.isElevator()) return renderer.setInstrument(assets::elevator(formOf(tool.elevator)));
  if (tool.isHandInstrument()) return renderer.setInstrument(assets::handInstrument(formOf(tool.hand_instrument)));
  renderer.setInstrument(assets::surgicalHandpiece(drawnAs(tool)));
}

void showFile(render::FrameRenderer& renderer, const haptics::CanalFile& file, const haptics::FileWork& work,
              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT) {
  const auto made = file.made();
  const auto cone = file.cone();
  if (!made && !cone) return;
  if (cone && work.stay == haptics::FileStay::none)
    return renderer.setInstrument(assets::canalCone({.cone = *cone, .node_T_mm = {}, .is_held = true}));
  if (work.stay == haptics::FileStay::none)
    return renderer.setInstrument(
        assets::canalFile({.file = *made, .node_T_mm = {}, .torque_share = {}, .stop_mm = file.stop_mm}));
  const auto X_TP = X_PT.inverse();
  std::vector<glm::vec3> node_T_mm(work.node_P_mm.size());
  std::ranges::transform(work.node_P_mm, node_T_mm.begin(), [&](const glm::vec3& node_P) {
    return glm::vec3((X_TP * calibration::Point<calibration::Patient>{glm::dvec3(node_P)}).mm);
  });
  // Open pliers, until the hand is out for the next one.
  if (cone)
    return renderer.setInstrument(
        assets::canalCone({.cone = *cone, .node_T_mm = node_T_mm, .is_held = work.stay != haptics::FileStay::through}));
  // The handle turns with the hand; what the tip lags behind is seen along the flutes.
  renderer.setInstrument(assets::canalFile({.file = *made,
                                            .node_T_mm = node_T_mm,
                                            .whole_mm = made->length_mm,
                                            .torque_share = work.link_share,
                                            .stop_mm = file.stop_mm,
                                            .roll_rad = work.windup_rad}));
}

void showFragments(render::FrameRenderer& renderer, std::span<const assets::MetalFragment> fragments) {
  renderer.setFragments(assets::fragmentWires(fragments));
}

void showForceps(render::FrameRenderer& renderer, double opening_mm) {
  renderer.setInstrument(assets::forceps(opening_mm));
}

}  // namespace app
