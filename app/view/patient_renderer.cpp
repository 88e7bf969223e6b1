#include "app/view/patient_renderer.h"

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
  drawn.neck_radius_mm = tool.shaft.radius_mm;
  drawn.handpiece = tool.handpiece;
  return drawn;
}
static_assert(static_cast<int>(assets::BurForm::cone) == static_cast<int>(haptics::ShapeKind::cone));

assets::ElevatorForm formOf(haptics::ElevatorKind kind) {
  return static_cast<assets::ElevatorForm>(static_cast<int>(kind) - 1);
}
static_assert(static_cast<int>(assets::ElevatorForm::cryer_right) + 1 ==
              static_cast<int>(haptics::ElevatorKind::cryer_right));

assets::HandInstrumentForm formOf(haptics::HandInstrument kind) {
  return static_cast<assets::HandInstrumentForm>(static_cast<int>(kind) - 1);
}
static_assert(static_cast<int>(assets::HandInstrumentForm::suction) + 1 ==
              static_cast<int>(haptics::HandInstrument::suction));

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
  return renderer;
}

void showInstrument(render::FrameRenderer& renderer, const haptics::Tool& tool) {
  if (tool.grips) return showForceps(renderer, kOpenBeaks_mm);
  if (tool.isElevator()) return renderer.setInstrument(assets::elevator(formOf(tool.elevator)));
  if (tool.isHandInstrument()) return renderer.setInstrument(assets::handInstrument(formOf(tool.hand_instrument)));
  renderer.setInstrument(assets::surgicalHandpiece(drawnAs(tool)));
}

void showForceps(render::FrameRenderer& renderer, double opening_mm) {
  renderer.setInstrument(assets::forceps(opening_mm));
}

}  // namespace app
