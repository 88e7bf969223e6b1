#include "app/rehearsal/file_sight.h"

#include <algorithm>
#include <limits>

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

void showFileSight(const assets::ToothCanals& tooth, const haptics::Tick& tick, const haptics::Tool& tool,
                   render::ViewMode mode, render::Frame& frame) {
  const bool in_hand = tool.isFile() && tick.file.stay != haptics::FileStay::none;
  frame.mode = in_hand && frame.layers.clear_tooth && mode == render::ViewMode::iso ? render::ViewMode::clear : mode;
  frame.magnified.reset();
  if (in_hand && frame.layers.tip_inset && fromOrifice_mm(tooth, tick.file.tip_P_mm) < kNear_mm)
    frame.magnified = render::Magnified{{tick.file.tip_P_mm}, -tick.file.tip_axis_P};
}

}  // namespace app
