#include "app/debrief/debrief_picture.h"

#include <algorithm>
#include <chrono>

#include "app/case/patient_placement.h"
#include "app/device/second_hand.h"
#include "app/options/picture_option.h"
#include "app/rehearsal/file_sight.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/loose_site.h"
#include "app/session/fragments_event.h"
#include "app/session/locator_event.h"
#include "app/view/patient_renderer.h"

namespace app {

bool PictureChoice::operator==(const PictureChoice& other) const {
  return mode == other.mode && display == other.display && trail == other.trail && has_line == other.has_line &&
         other_ghost == other.other_ghost && edges == other.edges && layers.face_opacity == other.layers.face_opacity &&
         std::ranges::all_of(kPictureLayers,
                             [&](const PictureLayer& layer) { return layers.*layer.on == other.layers.*layer.on; });
}

DebriefPicture::DebriefPicture(DebriefRun& run, const render::RenderOptions& options)
    : run_(run), clearance_(run.risks()), head_up_(true, false) {
  const assets::Patient& patient = run.patient();
  // A continued rehearsal began with what was left.
  renderer_ = patientRenderer(patient, run.moments().command().tool, run.cut(), run.moments().start().solid, options);
  frame_.site_P = {patient.focus_P_mm()};
  frame_.X_PT.translation_mm = frame_.site_P.mm;
}

calibration::Rig DebriefPicture::firstRig(const DebriefRun& run, glm::ivec2 px, double loupes) {
  // A narrow picture shows the same site, not less of it.
  constexpr double kUsualShape = 1.6;
  const double shape = static_cast<double>(px.x) / std::max(1, px.y);
  calibration::Rig rig =
      calibration::desktopRig(px, calibration::kDeskMonitorWidth_mm / loupes * std::max(0.6, shape / kUsualShape));
  rig.X_WP = placePatientAtSite(run.patient(), run.patient().X_PF.value_or(assets::kFaceAxes_PF));
  return rig;
}

void DebriefPicture::update(const PictureChoice& choice, const calibration::Rig& rig, double face_window_mm,
                            const haptics::Tick* other_tick, DebriefRun::Look look) {
  SessionMoments& moments = run_.moments();
  const haptics::Tick& tick = moments.tick();
  const haptics::Command& command = moments.command();
  if (!shown_tool_ || !(*shown_tool_ == command.tool)) {
    shown_tool_ = command.tool;
    showInstrument(*renderer_, command.tool);
  }
  frame_ = nextFrame(frame_, tick, command);
  if (command.tool.isFile()) showFile(*renderer_, command.tool.file, tick.file, frame_.X_PT);
  frame_.rig = rig;
  frame_.display = choice.display;
  frame_.face_window_mm = face_window_mm;
  frame_.mode = choice.mode;
  frame_.layers = choice.layers;
  if (run_.patient().canals) showFileSight(*run_.patient().canals, tick, command.tool, choice.mode, frame_);
  if (choice.other_ghost && other_tick != nullptr && other_tick->dt_s > 0.0) {
    frame_.layers.ghost_tool = true;
    frame_.X_PT_at_hand = {other_tick->heldRotation(), other_tick->proxy_P.mm};
  }
  showLeft(tick);
  showSecondHand(tick);
  frame_.field = surgicalField(moments.clarity());
  frame_.pieces = movedPieces(tick);
  frame_.beads = trailOf(run_.story().samplesBefore(tick.t_s, DebriefPicture::kTrail_s), choice.trail);
  edges_mm_.reset();
  if (choice.edges) showEdges(look);
  run_.site().show(tick.t_s + tick.dt_s, frame_);
  if (run_.flap() != nullptr) run_.flap()->show(tick.t_s + tick.dt_s, frame_);
  uploader_.tell(run_.takeChangedBricks());
  uploader_.upload(moments.bodies(), frame_.pieces, *renderer_);
  frame_.gap = frame_.tool_visible && !command.tool.isFile() ? renderer_->gap(frame_) : std::nullopt;

  std::vector<render::OverlayPanel> panels;
  if (choice.has_line) {
    clearance_.update(tick, command.tool);
    Situation situation = situationOf(tick, command, run_.patient(), false, false);
    situation.canal_mm = clearance_.canal_mm();
    HeadUp::Values values{situation,
                          frame_.gap ? std::optional(frame_.gap->mm) : std::nullopt,
                          "",
                          "",
                          tick.site == haptics::SiteAnswer::ready,
                          ""};
    for (const SessionEvent& event : moments.events())
      if (event.kind == kLocatorEvent && event.tick <= tick.index) {
        const auto told = locatorFrom(event.text);
        values.locator = told ? std::optional(HeadUpLocator{told->left_mm, told->is_apex}) : std::nullopt;
      }
    values.clearances = clearance_.ruler(run_.patient().proposed());
    line_.update(head_up_.content(values, std::chrono::steady_clock::now()),
                 headUpPlace(frame_.rig, frame_.display, frame_));
    panels = line_.panels();
  }
  renderer_->setOverlay(std::move(panels));
}

/// Of broken files, in the tooth at that moment.
void DebriefPicture::showLeft(const haptics::Tick& tick) {
  auto lying = fragmentsIn(run_.moments().start().setup, run_.moments().events(), tick.index);
  if (lying == shown_fragments_) return;
  shown_fragments_ = std::move(lying);
  showFragments(*renderer_, shown_fragments_);
}

void DebriefPicture::showSecondHand(const haptics::Tick& tick) {
  // Noted with the tick that was the newest.
  const auto place = tick.dt_s > 0.0 ? run_.secondHand().at(tick.t_s + 0.5 * tick.dt_s) : std::nullopt;
  frame_.second_visible = place.has_value();
  if (!place) return;
  frame_.X_PO = place->X_PO;
  frame_.second_glass = glassOf(place->instrument);
  if (shown_second_ == place->instrument) return;
  shown_second_ = place->instrument;
  renderer_->setSecondInstrument(assets::entryOf(place->instrument).model());
}

void DebriefPicture::showEdges(DebriefRun::Look look) {
  const std::vector<SharpEdge>* const edges = run_.sharpEdges(look);
  if (edges == nullptr) return;
  edges_mm_ = 0.0;
  for (const SharpEdge& edge : *edges) {
    *edges_mm_ += edge.length_mm;
    for (const glm::dvec3& p : edge.points_P_mm) frame_.beads.push_back(edgeMark(p));
  }
}

void DebriefPicture::draw(const render::Quality& quality) {
  frame_.quality = quality;
  renderer_->render(frame_);
  renderer_->throwIfError();
}

}  // namespace app
