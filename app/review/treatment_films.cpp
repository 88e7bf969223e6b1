#include "app/review/treatment_films.h"

#include <algorithm>

#include "app/procedure/root_canal/dense_tooth.h"
#include "app/view/radiograph_picture.h"
#include "assets/scan/fine_radiograph.h"
#include "assets/scan/metal_shadow.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// Half as fine: a film has 0.1 mm a pixel, and sums along a beam are those of the means.
struct Halved {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;
};

Halved halved(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
              const haptics::Filling::Volumes* filling) {
  const bool is_filled = filling != nullptr && !filling->laid.empty();
  Halved half{grid, {}, {}};
  constexpr int kBlock = assets::ToothSampler::kEdge;
  half.grid.size = grid.size / (2 * kBlock) * kBlock;
  half.grid.spacing_mm = 2.0 * grid.spacing_mm;
  half.grid.origin_P_mm = grid.origin_P_mm + 0.5 * grid.spacing_mm;
  half.solid.resize(half.grid.voxelCount()), half.label.resize(half.grid.voxelCount());
  assets::forVoxels(half.grid, [&](glm::ivec3 ijk, std::size_t v) {
    int sum = 0, most = -1;
    assets::forVoxels(2 * ijk, 2 * ijk + 2, [&](glm::ivec3 of) {
      const std::size_t at = grid.index(of);
      sum += solid[at];
      if (solid[at] > most) most = solid[at], half.label[v] = label[at];
      if (!is_filled || filling->laid[at] == 0) return;
      sum += filling->laid[at];
      if (filling->laid[at] >= most) most = filling->laid[at], half.label[v] = filling->tissue[at];
    });
    half.solid[v] = static_cast<std::uint8_t>(std::min(255, (sum + 4) / 8));
  });
  return half;
}

assets::CtVolume aloneIn(const Halved& half, int fdi) {
  assets::CtVolume ct{half.grid, {}, half.label, half.solid, {}};
  ct.tooth.resize(ct.label.size());
  std::ranges::transform(ct.label, ct.tooth.begin(), [fdi](std::uint8_t label) {
    return static_cast<std::uint8_t>(assets::isToothPart(label) ? fdi : 0);
  });
  return ct;
}

bool isIn(const assets::CtVolume* jaw, int fdi) {
  return jaw != nullptr && std::ranges::count(jaw->tooth, static_cast<std::uint8_t>(fdi)) > 0;
}

/// `jaw`: null: the tooth alone.
render::Image exposed(const Halved& tooth, std::span<const assets::MetalFragment> metal, const assets::CtVolume* jaw,
                      int fdi, const assets::PeriapicalView& view, double shift_deg) {
  std::vector<float> bone_mm =
      jaw != nullptr ? assets::fineRadiographOf(*jaw, fdi, DenseTooth(tooth.grid, tooth.solid, tooth.label), view)
                     : assets::radiographOf(tooth.grid, tooth.solid, tooth.label, view);
  assets::addMetal(view, metal, bone_mm);
  return radiographPicture(view, bone_mm, fdi, shift_deg);
}

}  // namespace

TreatmentFilms treatmentFilms(const StoredStart& start, const FilmedTooth& after, const assets::CtVolume* jaw) {
  const int fdi = start.setup.canals->fdi;
  const Halved was = halved(start.grid, start.solid, start.label, nullptr);
  const Halved is = halved(start.grid, after.solid, start.label, after.filling);
  const assets::CtVolume alone = aloneIn(was, fdi);
  TreatmentFilms films;
  films.in_jaw = isIn(jaw, fdi);
  const assets::CtVolume* const around = films.in_jaw ? jaw : nullptr;
  for (const double shift_deg : kTubeShifts_deg) {
    const auto view = assets::periapicalViewOf(films.in_jaw ? *jaw : alone, fdi, shift_deg);
    if (!view) break;
    films.pairs.push_back({shift_deg, exposed(was, start.setup.fragments, around, fdi, *view, shift_deg),
                           exposed(is, after.fragments, around, fdi, *view, shift_deg)});
  }
  return films;
}

std::optional<render::Image> treatmentFilm(const StoredStart& start, const FilmedTooth& tooth,
                                           const assets::CtVolume* jaw, double shift_deg) {
  const int fdi = start.setup.canals->fdi;
  const Halved half = halved(start.grid, tooth.solid, start.label, tooth.filling);
  const assets::CtVolume* const around = isIn(jaw, fdi) ? jaw : nullptr;
  const auto view = assets::periapicalViewOf(around != nullptr ? *around : aloneIn(half, fdi), fdi, shift_deg);
  if (!view) return {};
  return exposed(half, tooth.fragments, around, fdi, *view, shift_deg);
}

}  // namespace app
