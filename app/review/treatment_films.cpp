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

Halved halved(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
              std::span<const std::uint8_t> label) {
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
      if (solid[at] <= most) return;
      most = solid[at];
      half.label[v] = label[at];
    });
    half.solid[v] = static_cast<std::uint8_t>((sum + 4) / 8);
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

}  // namespace

TreatmentFilms treatmentFilms(const StoredStart& start, std::span<const std::uint8_t> solid_after,
                              std::span<const assets::MetalFragment> fragments, const assets::CtVolume* jaw) {
  const int fdi = start.setup.canals->fdi;
  const Halved before = halved(start.grid, start.solid, start.label);
  const Halved after = halved(start.grid, solid_after, start.label);
  const assets::CtVolume alone = aloneIn(before, fdi);
  TreatmentFilms films;
  films.in_jaw = jaw != nullptr && std::ranges::count(jaw->tooth, static_cast<std::uint8_t>(fdi)) > 0;
  for (const double shift_deg : kTubeShifts_deg) {
    const auto view = assets::periapicalViewOf(films.in_jaw ? *jaw : alone, fdi, shift_deg);
    if (!view) break;
    const auto film = [&](const Halved& tooth, std::span<const assets::MetalFragment> metal) {
      std::vector<float> bone_mm =
          films.in_jaw ? assets::fineRadiographOf(*jaw, fdi, DenseTooth(tooth.grid, tooth.solid, tooth.label), *view)
                       : assets::radiographOf(tooth.grid, tooth.solid, tooth.label, *view);
      assets::addMetal(*view, metal, bone_mm);
      return radiographPicture(*view, bone_mm, fdi, shift_deg);
    };
    films.pairs.push_back({shift_deg, film(before, start.setup.fragments), film(after, fragments)});
  }
  return films;
}

}  // namespace app
