#include "app/debrief/flap_film.h"

#include <algorithm>
#include <utility>

#include "app/procedure/flap/flap_mesh.h"

namespace app {

FlapFilm::FlapFilm(const assets::Patient& patient, const assets::PlannedCut& cut, const assets::MeshModel& closed_gum_P,
                   const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P)
    : flap_(patient, closed_gum_P, cut, soft_tissue, down_P) {
  gums_.push_back({0.0, closed_gum_P});
}

void FlapFilm::follow(const haptics::Tick& tick, const haptics::Command& command) {
  flap_.follow(tick, command);
  while (flap_.news()) {
  }
  const double now_s = tick.t_s + tick.dt_s;
  if (now_s >= next_s_) keep(now_s);
}

void FlapFilm::keep(double t_s) {
  if (flap_.sheet() && kept_number_ != flap_.sheetNumber()) {
    kept_number_ = flap_.sheetNumber();
    gums_.push_back({t_s, gumAround(gums_.front().model, flap_.chart(), *flap_.sheet())});
  }
  if (kept_sheet_ == flap_.sheetRevision() && kept_incision_ == flap_.incisionRevision()) return;
  kept_sheet_ = flap_.sheetRevision(), kept_incision_ = flap_.incisionRevision();
  sheets_.push_back({t_s, ++serial_, flapMesh(flap_)});
  next_s_ = t_s + between_s_;
  if (sheets_.size() <= kMost) return;
  // Half as many a second from here on, and from before.
  std::vector<Sheet> left;
  for (std::size_t n = 0; n < sheets_.size(); n += 2) left.push_back(std::move(sheets_[n]));
  sheets_ = std::move(left);
  between_s_ *= 2.0;
}

void FlapFilm::show(double t_s, render::Frame& frame) const {
  const auto gum = std::prev(std::ranges::upper_bound(gums_, std::max(t_s, 0.0), {}, &Gum::t_s));
  frame.gum = &gum->model;
  frame.gum_serial = 1 + static_cast<std::uint64_t>(gum - gums_.begin());
  const auto after = std::ranges::upper_bound(sheets_, t_s, {}, &Sheet::t_s);
  const bool any = after != sheets_.begin() && !std::prev(after)->model.parts.empty();
  frame.flap = any ? &std::prev(after)->model : nullptr;
  frame.flap_serial = any ? std::prev(after)->serial : 0;
}

}  // namespace app
