#include "app/debrief/flap_film.h"

#include "app/procedure/flap/flap_mesh.h"

namespace app {

FlapFilm::FlapFilm(const assets::Patient& patient, const assets::PlannedCut& cut, const assets::MeshModel& closed_gum_P,
                   const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P)
    : flap_(patient, closed_gum_P, cut, soft_tissue, down_P), closed_gum_P_(closed_gum_P) {}

void FlapFilm::follow(const haptics::Tick& tick, const haptics::Command& command) {
  flap_.follow(tick, command);
  while (flap_.news()) {
  }
  const double now_s = tick.t_s + tick.dt_s;
  if (sheets_.isDue(now_s)) keep(now_s);
}

void FlapFilm::keep(double t_s) {
  if (flap_.sheet() && kept_number_ != flap_.sheetNumber()) {
    kept_number_ = flap_.sheetNumber();
    gums_.keep(t_s, gumAround(closed_gum_P_, flap_.chart(), *flap_.sheet()));
  }
  if (kept_sheet_ == flap_.sheetRevision() && kept_incision_ == flap_.incisionRevision()) return;
  kept_sheet_ = flap_.sheetRevision(), kept_incision_ = flap_.incisionRevision();
  sheets_.keep(t_s, flapMesh(flap_));
}

void FlapFilm::show(double t_s, render::Frame& frame) const {
  const auto* const gum = gums_.at(t_s);
  frame.gum = gum != nullptr ? &gum->content : &closed_gum_P_;
  frame.gum_serial = gum != nullptr ? gum->serial + 1 : 1;  // the closed one is the first
  const auto* const sheet = sheets_.at(t_s);
  const bool any = sheet != nullptr && !sheet->content.parts.empty();
  frame.flap = any ? &sheet->content : nullptr;
  frame.flap_serial = any ? sheet->serial : 0;
}

}  // namespace app
