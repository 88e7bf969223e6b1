// Incision and flap of a recorded session as they were drawn, for any moment of it: computed again from the ticks as in
// the rehearsal (app/procedure/flap), kept a few times a second where they changed. Frame P. Any one thread. Computing:
// 0.3 ms per 10 ms of session while a sheet is raised; memory: about 0.1 MB a picture, at most kMost of them, and some
// MB for each time that a sheet was laid, at most kMostGums.
#pragma once

#include <cstdint>

#include "app/debrief/film.h"
#include "app/procedure/flap/flap.h"
#include "assets/mesh.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "render/frame.h"

namespace app {

class FlapFilm {
 public:
  static constexpr std::size_t kMost = 600, kMostGums = 32;

  /// Borrows soft tissue and `closed_gum_P`, with the flap's part. `down_P`: as the patient lay.
  FlapFilm(const assets::Patient& patient, const assets::PlannedCut& cut, const assets::MeshModel& closed_gum_P,
           const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P);

  /// Every tick in order, made with this command.
  void follow(const haptics::Tick& tick, const haptics::Command& command);
  /// As it was at a moment that has been followed.
  void show(double t_s, render::Frame& frame) const;
  /// FlapRecord::digest of the newest.
  std::uint64_t digest() const { return flap_.record().digest; }

 private:
  void keep(double t_s);

  Flap flap_;
  std::uint64_t kept_sheet_ = 0, kept_incision_ = 0, kept_number_ = 0;
  const assets::MeshModel& closed_gum_P_;
  Film<assets::MeshModel> gums_{kMostGums, 0.0};  ///< around the sheets that were laid
  Film<assets::MeshModel> sheets_{kMost, 0.1};
};

}  // namespace app
