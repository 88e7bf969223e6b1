#include "app/rehearsal/locator_watch.h"

#include <cmath>

#include <fmt/core.h>

namespace app {

LocatorWatch::LocatorWatch(const assets::ToothCanals& tooth, const assets::CtVolume& scan, ApexLocator::Mode mode,
                           std::uint64_t seed)
    : tooth_(tooth),
      locator_(tooth, scan, mode, seed),
      settings_(mode == ApexLocator::Mode::exact ? "exact" : fmt::format("real, seed {}", seed)) {}

bool LocatorWatch::follow(const haptics::Tick& tick, bool is_dry, bool is_metal) {
  std::optional<LocatorTold> now;
  if (is_metal && tick.file.stay != haptics::FileStay::none)
    if (const auto reading = locator_.at(tick.file.tip_P_mm, tick.t_s, is_dry)) {
      const bool is_hole = reading->place == LocatorReading::Place::perforation || !reading->canal;
      now = LocatorTold{0.1 * std::round(10.0 * reading->left_mm), reading->isApex(),
                        is_hole ? "perforation" : tooth_.canals[*reading->canal].name};
      // A display rests while the reading wavers about the middle between two tenths.
      constexpr double kRests_mm = 0.08;
      if (told_ && !told_->is_apex && !now->is_apex && told_->where == now->where &&
          std::fabs(reading->left_mm - told_->left_mm) < kRests_mm)
        now = told_;
    }
  if (now == told_) return false;
  told_ = now;
  return true;
}

}  // namespace app
