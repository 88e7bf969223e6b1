#include "app/session/measures/practice_measures.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "assets/ct_volume.h"
#include "assets/trilinear.h"

namespace app {
namespace {

using assets::fromBlock;

double solidAt(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, const glm::dvec3& p_P_mm) {
  return assets::trilinearAt(grid, p_P_mm,
                             [&](glm::ivec3 ijk) { return grid.contains(ijk) ? solid[grid.index(ijk)] / 255.0 : 0.0; });
}

/// Columns out of the face, 0.2 mm apart: what is left between the plate's back and air.
void tellPlate(std::vector<MeasureValue>& values, const assets::VolumeGrid& grid, std::span<const std::uint8_t> after) {
  constexpr double kApart_mm = 0.2, kStep_mm = 0.05, kThrough_mm = 0.1;
  double least_mm = 1e9, sum_mm = 0.0;
  int columns = 0, through = 0;
  for (double y = -assets::kPlateWindow_mm.y; y <= assets::kPlateWindow_mm.y; y += kApart_mm)
    for (double x = -assets::kPlateWindow_mm.x; x <= assets::kPlateWindow_mm.x; x += kApart_mm) {
      double left_mm = 0.0;
      for (double z = assets::kPlateBack_mm - 0.5; z < 0.5; z += kStep_mm)
        if (solidAt(grid, after, fromBlock({x, y, z})) >= 0.5) left_mm += kStep_mm;
      least_mm = std::min(least_mm, left_mm), sum_mm += left_mm, ++columns;
      if (left_mm < kThrough_mm) ++through;
    }
  values.push_back({"B.plate_least", "plate left, least; 1 mm is wanted", "mm", least_mm, {}, {}});
  values.push_back({"B.plate_mean", "plate left, mean", "mm", sum_mm / columns, {}, {}});
  values.push_back({"B.plate_through", "plate broken through", "mm2", through * kApart_mm * kApart_mm, {}, {}});
}

/// Over its upper half, places evenly spread: bare where nothing but the ball stands out of the face above.
void tellBall(std::vector<MeasureValue>& values, const assets::VolumeGrid& grid, std::span<const std::uint8_t> label,
              std::span<const std::uint8_t> before, std::span<const std::uint8_t> after) {
  constexpr int kPlaces = 2000;
  constexpr double kOff_mm = 0.3, kStep_mm = 0.1;
  const glm::dvec3 middle(0.0, 0.0, assets::kBallMiddle_mm);
  int bare = 0;
  for (int n = 0; n < kPlaces; ++n) {
    const double z = (n + 0.5) / kPlaces, turn = n * 2.399963229728653, side = std::sqrt(1.0 - z * z);
    const glm::dvec3 place =
        middle + (assets::kBallRadius_mm + kOff_mm) * glm::dvec3(side * std::cos(turn), side * std::sin(turn), z);
    bool is_bare = true;
    for (double up = 0.0; is_bare && place.z + up < 0.5; up += kStep_mm)
      is_bare = solidAt(grid, after, fromBlock(place + glm::dvec3(0.0, 0.0, up))) < 0.5;
    bare += is_bare ? 1 : 0;
  }
  double cut = 0.0;
  for (std::size_t v = 0; v < label.size(); ++v)
    if (assets::Tissue{label[v]} == assets::Tissue::enamel && before[v] > after[v])
      cut += (before[v] - after[v]) / 255.0;
  values.push_back({"B.ball_bare",
                    "share of the ball's upper half that lies bare",
                    "",
                    static_cast<double>(bare) / kPlaces,
                    {},
                    {}});
  values.push_back({"B.ball_cut", "cut of the ball; none is wanted", "mm3", cut * grid.voxelVolume_mm3(), {}, {}});
}

}  // namespace

std::vector<MeasureValue> practiceMeasures(assets::PracticeTask task, const assets::VolumeGrid& grid,
                                           std::span<const std::uint8_t> label, std::span<const std::uint8_t> before,
                                           std::span<const std::uint8_t> after) {
  std::vector<MeasureValue> values;
  if (task == assets::PracticeTask::plate) tellPlate(values, grid, after);
  if (task == assets::PracticeTask::ball) tellBall(values, grid, label, before, after);
  for (MeasureValue& value : values) value.conditions = fmt::format("voxel {:g} mm", grid.spacing_mm);
  return values;
}

}  // namespace app
