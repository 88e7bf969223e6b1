// One tooth as a volume of densities, a byte a voxel: air 0, pulp 100, dentine 150, enamel 255 (levels of published
// tooth models; others where they are given), and values between them where a voxel is shared by two. The volume is
// judged before it is believed: levels by their share of the voxels, root and crown by enamel and pulp, one piece, the
// size of a tooth; what does not fit is refused in a line. Partial voxels at the outside get the tissue beneath and
// their share of it. Frame P (LPS mm) as in the file, unless it is turned upright. Only voxels and geometry are kept.
// Any thread; some 0.3 s per 10^6 voxels.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "assets/ct_volume.h"

namespace assets {

/// Of air, pulp, dentine, enamel; rising.
using ToothLevels = std::array<int, 4>;
inline constexpr ToothLevels kToothLevels{0, 100, 150, 255};

struct ToothVolumeOptions {
  int fdi = 46;
  ToothLevels levels = kToothLevels;
  bool turns_upright = false;  ///< a tooth that lies or stands upside down; else it is refused
};

struct ToothVolume {
  CtVolume ct;  ///< the tooth alone in air, a margin of air around; `tooth` has its number
  bool has_pulp = false;
  std::vector<std::string> remarks;  ///< what was judged, a line each; nothing of the file's name
};

/// Throws LoadError of one line.
ToothVolume readToothVolume(const std::string& path, const ToothVolumeOptions& options);

/// The same of voxels that are read; `name` stands for them in messages.
ToothVolume toothVolume(VolumeGrid grid, std::vector<std::uint8_t> density, const ToothVolumeOptions& options,
                        const std::string& name);

}  // namespace assets
