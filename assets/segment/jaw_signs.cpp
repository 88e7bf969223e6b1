#include "assets/segment/jaw_signs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace assets {
namespace {

constexpr double kSmallTooth_mm3 = 90.0, kLargeTooth_mm3 = 2600.0, kLongTooth_mm = 32.0;
constexpr double kLeastCap_mm = 1.0, kOffRow_mm = 9.0, kOverSheet_mm = 6.0, kUnderSheet_mm = 32.0;
constexpr double kBoneFrom_mm = 1.5, kBoneTo_mm = 8.0, kLeastBone_mm = 2.0;
constexpr double kWithin_mm = -12.0, kWithinAngle_rad = 1.2, kTongueFrom_mm = -22.0, kTongueTo_mm = -2.0;
constexpr float kHard_hu = 480.0F;

/// Of the jaw under a tooth's lowest place; none where the scan ends there.
std::optional<bool> hasBoneBelow(const Mandible& jaw, const FoundTooth& tooth) {
  int bone = 0;
  const glm::dvec3 at = jaw.grid.indexFromPoint({tooth.centre_P_mm.x, tooth.centre_P_mm.y, tooth.low_z_P_mm});
  const int from = static_cast<int>(std::floor(at.z - kBoneTo_mm / jaw.grid.spacing_mm)),
            to = static_cast<int>(std::floor(at.z - kBoneFrom_mm / jaw.grid.spacing_mm));
  if (jaw.first.z + from < 0) return std::nullopt;
  for (int k = from; k <= to; ++k) {
    const glm::ivec3 ijk(std::lround(at.x), std::lround(at.y), k);
    if (jaw.grid.contains(ijk) && jaw.solid[jaw.grid.index(ijk)] != 0) ++bone;
  }
  return bone * jaw.grid.spacing_mm >= kLeastBone_mm;
}

}  // namespace

bool hasToothSize(const FoundTooth& tooth) {
  return tooth.volume_mm3 > kSmallTooth_mm3 && tooth.volume_mm3 < kLargeTooth_mm3 &&
         std::max({tooth.extent_mm.x, tooth.extent_mm.y, tooth.extent_mm.z}) < kLongTooth_mm;
}

JawSigns jawSigns(const Mandible& jaw, const JawArch& arch, const BiteSheet& sheet,
                  const std::vector<FoundTooth>& teeth) {
  double capped = 0.0, up = 0.0, in_row = 0.0, over_bone = 0.0, known_below = 0.0;
  JawSigns signs;
  for (const FoundTooth& tooth : teeth) {
    if (!hasToothSize(tooth)) continue;
    ++signs.tooth_sized;
    if (glm::length(tooth.crown_P_mm) >= kLeastCap_mm) {
      capped += 1.0;
      if (tooth.crown_P_mm.z > 0.0) up += 1.0;
    }
    const double above_mm = sheet.aboveAndBehind_mm(arch, tooth.centre_P_mm).x;
    if (std::abs(arch.outside_mm(tooth.centre_P_mm)) < kOffRow_mm && above_mm < kOverSheet_mm &&
        above_mm > -kUnderSheet_mm)
      in_row += 1.0;
    if (const std::optional<bool> has_bone = hasBoneBelow(jaw, tooth)) known_below += 1.0, over_bone += *has_bone;
  }
  if (signs.tooth_sized == 0) return signs;
  const double all = signs.tooth_sized;
  signs.capped = capped / all;
  signs.crowns_up = capped > 0.0 ? up / capped : 0.0;
  signs.in_row = in_row / all;
  signs.over_bone = known_below > 0.0 ? over_bone / known_below : 1.0;
  return signs;
}

double hardWithinArch(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch,
                      const BiteSheet& sheet) {
  if (arch.is_one_sided) return 0.0;
  double hard = 0.0, all = 0.0;
  forVoxels(cells, [&](glm::ivec3 ijk, std::size_t n) {
    const glm::dvec3 p = cells.centre_P_mm(ijk);
    const double above_mm = sheet.aboveAndBehind_mm(arch, p).x;
    if (above_mm < kTongueFrom_mm || above_mm > kTongueTo_mm) return;
    if (std::abs(arch.angleOf(p)) > kWithinAngle_rad || arch.outside_mm(p) > kWithin_mm) return;
    all += 1.0;
    if (smooth_hu[n] > kHard_hu) hard += 1.0;
  });
  return all > 0.0 ? hard / all : 0.0;
}

}  // namespace assets
