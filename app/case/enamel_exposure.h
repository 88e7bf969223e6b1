// How much of the crown that the plan lays bare is bare: the places of the crown's surface that become open by the plan
// alone, and the share of them that the bone as it is now leaves open. Open: no bone or other tooth on one of a few
// straight ways out, along the plan's way in and up to 35 degrees beside it. Frame P, mm. Construction some tenths of a
// second, a query some ms; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace app {

class EnamelExposure {
 public:
  /// `before`: the jaw as scanned, in the order of the volume's grid; its labels are those of `ct`.
  EnamelExposure(const assets::CtVolume& ct, std::span<const std::uint8_t> before, const assets::OperativeSite& site,
                 const assets::PlannedCut& cut);

  /// Of the crown's surface that the plan exposes, one voxel's face counted as its square.
  double planned_mm2() const;
  /// 0..1 of it that `solid`, in the order of the volume's grid, leaves open; 1 where nothing is planned.
  double share(std::span<const std::uint8_t> solid) const;

 private:
  bool isOpen(std::size_t place, std::span<const std::uint8_t> solid) const;

  assets::VolumeGrid grid_;
  std::vector<glm::dvec3> ways_out_;
  std::vector<glm::ivec3> places_;  ///< voxels of the crown's surface that the plan opens
};

}  // namespace app
