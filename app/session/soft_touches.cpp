#include "app/session/soft_touches.h"

#include <fmt/core.h>

#include "app/session/touch_event.h"

namespace app {
/// True where a touch begins.
bool SoftTouchCounter::count(SoftTouches::Count& count, double& last_s, bool now, const haptics::Tick& tick) {
  if (!now) return false;
  const bool begins = tick.t_s - last_s > kTouchPause_s;
  if (begins) ++count.times;
  count.seconds += tick.dt_s;
  last_s = tick.t_s + tick.dt_s;
  return begins;
}

void SoftTouchCounter::add(const haptics::Tick& tick) {
  if (!tick.soft.touches() && tick.soft.bur_cuts == assets::SoftTissue::none) return;
  for (std::size_t n = 1; n < assets::kSoftTissueCount; ++n) {
    const auto tissue = static_cast<assets::SoftTissue>(n);
    const std::string_view name = assets::properties(tissue).name;
    if (count(counts_.touched[n], touched_s_[n], assets::contains(tick.soft.tissues, tissue), tick))
      events_.push_back(fmt::format("{} touched at {:.1f} s", name, tick.t_s));
    if (count(counts_.cut[n], cut_s_[n], tick.soft.bur_cuts == tissue, tick))
      events_.push_back(fmt::format("bur on {} at {:.1f} s", name, tick.t_s));
  }
}

std::string softTouchesText(const std::array<SoftTouches::Count, assets::kSoftTissueCount>& counts) {
  std::vector<TouchCount> touched;
  for (std::size_t n = 1; n < counts.size(); ++n)
    if (counts[n].times > 0)
      touched.push_back({std::string(assets::kSoftTissues[n].name), counts[n].times, counts[n].seconds});
  return touchesText(touched);
}

}  // namespace app
