#include "app/check_page/label_bricks.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "app/check_page/jaw_views.h"

namespace app {
namespace {

std::uint8_t heldBy(std::uint8_t what) {
  if (what == 0) return 0;
  return what == kBoneVoxel ? LabelBricks::kBone : LabelBricks::kTooth;
}

}  // namespace

void LabelBricks::find(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what) {
  fine_size_ = (grid.size + (kFine - 1)) / kFine;
  coarse_size_ = (grid.size + (kCoarse - 1)) / kCoarse;
  fine_.assign(assets::countIn(fine_size_), 0);
  coarse_.assign(assets::countIn(coarse_size_), 0);
  // Nothing is shared between layers of coarse bricks.
  tbb::parallel_for(0, coarse_size_.z, [&](int layer) {
    const int end = std::min(grid.size.z, kCoarse * (layer + 1));
    for (int k = kCoarse * layer; k < end; ++k)
      for (int j = 0; j < grid.size.y; ++j) {
        const std::uint8_t* const row = what.data() + grid.index({0, j, k});
        for (int i = 0; i < grid.size.x; ++i)
          if (row[i] != 0) add({i, j, k}, row[i]);
      }
  });
}

void LabelBricks::add(const glm::ivec3& ijk, std::uint8_t what) {
  fine_[assets::indexIn(fine_size_, ijk / kFine)] |= heldBy(what);
  coarse_[assets::indexIn(coarse_size_, ijk / kCoarse)] |= heldBy(what);
}

}  // namespace app
