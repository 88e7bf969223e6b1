// Periapical radiographs of a treated tooth as it was and as it is left, from one side after the other: the tube
// straight and shifted by 20 degrees to either side, which parts two canals of one root. Within the jaw where it is
// known, else of the volume that was treated alone. Frame P, mm. Any one thread; some 0.3 s a film.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/session/session_start.h"
#include "assets/ct_volume.h"
#include "haptics/bone/filling.h"
#include "render/image.h"

namespace app {

inline constexpr std::array<double, 3> kTubeShifts_deg{0.0, 20.0, -20.0};

struct FilmPair {
  double shift_deg = 0.0;  ///< towards mesial
  render::Image before, after;
};

struct TreatmentFilms {
  std::vector<FilmPair> pairs;
  bool in_jaw = false;
};

/// A treated tooth as it is at some time.
struct FilmedTooth {
  std::span<const std::uint8_t> solid;
  std::span<const assets::MetalFragment> fragments;    ///< of files, in it
  const haptics::Filling::Volumes* filling = nullptr;  ///< null or empty: none
};

/// `start`: of a session with canals; `after`: at its end; `jaw`: the scan that its tooth is of, null or without that
/// tooth: not known.
TreatmentFilms treatmentFilms(const StoredStart& start, const FilmedTooth& after, const assets::CtVolume* jaw);

/// One film; none: it shows no such tooth.
std::optional<render::Image> treatmentFilm(const StoredStart& start, const FilmedTooth& tooth,
                                           const assets::CtVolume* jaw, double shift_deg);

}  // namespace app
