#include "haptics/bone/hardening.h"

#include <algorithm>

namespace haptics {
namespace {

using assets::Tissue;

bool waits(const Filling& filling, Tissue soft, double oldest_s) {
  return oldest_s >= settingOf(static_cast<std::uint8_t>(soft)).by_itself_s && filling.volume_mm3(soft) > 0.0;
}

std::int64_t setBlock(Filling& filling, std::size_t block, const IncrementAges& age_s) {
  BlockState state = filling.stateOf(block);
  std::int64_t set = 0;
  for (std::size_t n = 0; n < state.solid.size(); ++n) {
    const Setting setting = settingOf(state.reach[n]);
    if (state.solid[n] == 0 || setting.by_itself_s == 0.0) continue;
    if (age_s[state.dose[n] >> Filling::kIncrementShift] < setting.by_itself_s) continue;
    state.reach[n] = static_cast<std::uint8_t>(setting.into);
    set += state.solid[n];
  }
  if (set != 0) filling.restoreBlock(block, state);
  return set;
}

}  // namespace

std::int64_t Hardening::step(Filling& filling, const IncrementAges& age_s) noexcept {
  const double oldest_s = *std::max_element(age_s.begin(), age_s.end());
  if (!waits(filling, Tissue::amalgam_soft, oldest_s) && !waits(filling, Tissue::glass_ionomer_soft, oldest_s))
    return 0;
  const SolidField laid = filling.field();
  std::int64_t set = 0;
  int read = 0;
  for (int n = 0; n < kLookedAtPerTick && read < kBlocksPerTick; ++n, ++next_) {
    if (next_ >= filling.blocks()) next_ = 0;
    if (laid.weight[laid.slotOf(next_)] == 0) continue;
    set += setBlock(filling, next_, age_s);
    ++read;
  }
  return set;
}

}  // namespace haptics
