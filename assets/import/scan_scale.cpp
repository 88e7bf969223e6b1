#include "assets/import/scan_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace assets {
namespace {

constexpr int kBone_hu = 700, kMetal_hu = 3000;     // enamel ends at 2955 (Reshetnikov 2024)
constexpr int kNoAirBelow_hu = -300, kBin_hu = 16;  // fat lies at -100, air at -1000
constexpr double kMaxBone = 0.3, kMinMetal_mm3 = 10.0;

class Histogram {
 public:
  explicit Histogram(const std::vector<std::int16_t>& hounsfield) : all_(static_cast<double>(hounsfield.size())) {
    for (const std::int16_t value : hounsfield) ++count_[static_cast<std::size_t>(value + kShift)];
  }

  double above(int value) const { return between(value, std::numeric_limits<std::int16_t>::max()); }
  /// Share of the voxels above `low` and up to `high`.
  double between(int low, int high) const {
    double sum = 0.0;
    for (int value = low + 1; value <= std::min<int>(high, std::numeric_limits<std::int16_t>::max()); ++value)
      sum += static_cast<double>(count_[std::size_t(value + kShift)]);
    return sum / all_;
  }
  /// Value that a share of the voxels does not exceed.
  int percentile(double share) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < count_.size(); ++n)
      if ((sum += static_cast<double>(count_[n])) >= share * all_) return static_cast<int>(n) - kShift;
    return kShift - 1;
  }
  /// Middle of the fullest bin from `low` to `high`.
  int mode(int low, int high) const {
    int best = low;
    double most = -1.0;
    for (int start = low; start <= high; start += kBin_hu)
      if (const double share = between(start - 1, start + kBin_hu - 1); share > most) {
        most = share;
        best = start + kBin_hu / 2;
      }
    return best;
  }

 private:
  static constexpr int kShift = 32768;
  std::vector<std::size_t> count_ = std::vector<std::size_t>(65536);
  double all_;
};

/// Grey value of air, if it and the other tissues cannot be Hounsfield.
std::optional<int> offsetAir_hu(const Histogram& greys) {
  const int darkest = greys.percentile(0.001);
  if (darkest < kNoAirBelow_hu) return std::nullopt;
  const int air = greys.mode(darkest, std::max(darkest, greys.percentile(0.4)));
  const double bone = greys.above(kBone_hu), between = greys.between(air + 200, kBone_hu);
  // A head has soft tissue between air and bone; on an offset scale there is little.
  const bool is_offset = bone > kMaxBone || (bone > 0.05 && between < 0.35 * bone);
  return is_offset ? std::optional(air) : std::nullopt;
}

}  // namespace

std::vector<std::string> scaleRemarks(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) {
  const Histogram greys(hounsfield);
  if (const auto air = offsetAir_hu(greys))
    return {"its air seems to be at " + std::to_string(*air) +
            " HU instead of -1000, so everything counts as bone; export it in Hounsfield (often 1024 lower)"};
  const double metal_mm3 = greys.above(kMetal_hu - 1) * static_cast<double>(hounsfield.size()) * grid.voxelVolume_mm3();
  if (metal_mm3 < kMinMetal_mm3) return {};
  return {"about " + std::to_string(std::lround(metal_mm3)) +
          " mm3 are denser than enamel (3000 HU): metal, whose streaks look like spikes of bone"};
}

}  // namespace assets
