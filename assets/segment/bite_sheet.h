// The sheet between lower and upper teeth: for every angle of the arch the height with the least hard tissue across it,
// near the middle of what is dense, changing little from one angle to the next (dynamic programming). Where no upper
// teeth are in the scan it lies above the lower ones. Also the plane of the bite, level from side to side, whose slope
// towards the back is how the head is tilted in the scanner. Frame P, mm. Pure; any thread but the servo; 0.1 s.
#pragma once

#include <array>
#include <vector>

#include "assets/segment/jaw_arch.h"

namespace assets {

struct BiteSheet {
  std::array<double, kArchBins> z_P_mm{};
  double lower_dense_mm3 = 0.0, upper_dense_mm3 = 0.0;  ///< below and above it
  std::array<bool, kArchBins> has_both{};               ///< upper teeth over lower ones
  double front_z_P_mm = 0.0, slope = 0.0;               ///< of the plane: z = front + slope (y - centre of the arch)

  double height_P_mm = 0.0;  ///< median where there are teeth
  double planeHeight_P_mm(const JawArch& arch, double y_P_mm) const {
    return front_z_P_mm + slope * (y_P_mm - arch.centre_P_mm.y);
  }
  /// Above the plane, and behind the arch's centre along it.
  glm::dvec2 aboveAndBehind_mm(const JawArch& arch, const glm::dvec3& p_P_mm) const;
};

BiteSheet findBiteSheet(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch);

}  // namespace assets
