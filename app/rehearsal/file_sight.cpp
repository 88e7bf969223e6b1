#include "app/rehearsal/file_sight.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {
namespace {

constexpr double kNear_mm = 4.0;

}  // namespace

double fromOrifice_mm(const assets::ToothCanals& tooth, const glm::dvec3& tip_P_mm) {
  if (canalTip(tooth, tip_P_mm)) return 0.0;
  double least_mm = std::numeric_limits<double>::infinity();
  for (const assets::ToothCanal& canal : tooth.canals)
    least_mm = std::min(least_mm, glm::distance(canal.places.front().p_P_mm, tip_P_mm));
  return least_mm;
}

/// A hot plugger in the tooth is looked at as a file is.
static std::optional<render::Magnified> pluggerTip(const assets::ToothCanals& tooth, const haptics::Tick& tick,
                                                   const haptics::Tool& tool) {
  if (tool.hand_instrument != haptics::HandInstrument::root_plugger || tick.dt_s == 0.0) return {};
  if (fromOrifice_mm(tooth, tick.proxy_P.mm) >= kNear_mm) return {};
  return render::Magnified{tick.proxy_P, tick.heldRotation() * glm::dvec3(0.0, 0.0, 1.0)};
}

void showFileSight(const assets::ToothCanals& tooth, const haptics::Tick& tick, const haptics::Tool& tool,
                   render::ViewMode mode, render::Frame& frame) {
  const bool is_file = tool.isFile() && tick.file.stay != haptics::FileStay::none;
  const auto plugger = pluggerTip(tooth, tick, tool);
  const bool in_hand = is_file || plugger;
  frame.mode = in_hand && frame.layers.clear_tooth && mode == render::ViewMode::iso ? render::ViewMode::clear : mode;
  frame.magnified.reset();
  if (!in_hand || !frame.layers.tip_inset) return;
  if (plugger)
    frame.magnified = plugger;
  else if (fromOrifice_mm(tooth, tick.file.tip_P_mm) < kNear_mm)
    frame.magnified = render::Magnified{{tick.file.tip_P_mm}, -tick.file.tip_axis_P};
}

}  // namespace app
