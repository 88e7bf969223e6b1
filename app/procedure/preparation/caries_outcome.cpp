#include "app/procedure/preparation/caries_outcome.h"

#include <algorithm>
#include <cmath>

#include "assets/ct_volume.h"
#include "assets/scan/exact_distance.h"

namespace app {

CariesMeasure::CariesMeasure(const Crown& crown) {
  const std::span<const std::uint8_t> label = crown.label.bytes();
  if (std::ranges::none_of(label, assets::isCaries)) return;
  std::vector<std::uint8_t> pulp(label.size());
  std::ranges::transform(label, pulp.begin(), [](std::uint8_t tissue) {
    return static_cast<std::uint8_t>(assets::Tissue{tissue} == assets::Tissue::pulp ? 1 : 0);
  });
  const assets::VolumeGrid& grid = crown.label.grid();
  to_pulp_mm_ = assets::exactDistance_mm(grid.size, grid.spacing_mm, pulp);
}

CariesOutcome CariesMeasure::outcomeOf(const Crown& crown, const BoxBytes& made) const {
  CariesOutcome outcome;
  const assets::VolumeGrid& grid = made.grid();
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < made.bytes().size(); ++v) {
    const int had = crown.solid.bytes()[v], has = made.bytes()[v];
    const assets::Tissue tissue{crown.label.bytes()[v]};
    const bool is_sound = tissue == assets::Tissue::enamel || tissue == assets::Tissue::dentine;
    if (!is_sound && !assets::isCaries(crown.label.bytes()[v])) continue;
    if (tissue == assets::Tissue::caries_soft) outcome.soft_before_mm3 += had, outcome.soft_left_mm3 += has;
    if (tissue == assets::Tissue::caries_firm) outcome.firm_before_mm3 += had, outcome.firm_left_mm3 += has;
    if (is_sound) outcome.sound_cut_mm3 += had - has;
    if (had >= assets::kHalfSolid && has < assets::kHalfSolid)
      nearest_mm = std::min(nearest_mm, static_cast<double>(to_pulp_mm_[v]));
  }
  const double mm3 = grid.voxelVolume_mm3() / 255.0;
  for (double* sum : {&outcome.soft_before_mm3, &outcome.firm_before_mm3, &outcome.soft_left_mm3,
                      &outcome.firm_left_mm3, &outcome.sound_cut_mm3})
    *sum *= mm3;
  // From face to face of the voxels.
  if (std::isfinite(nearest_mm)) outcome.least_over_pulp_mm = std::max(0.0, nearest_mm - grid.spacing_mm);
  return outcome;
}

}  // namespace app
