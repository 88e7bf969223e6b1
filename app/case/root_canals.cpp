#include "app/case/root_canals.h"

#include <numbers>

#include <fmt/core.h>

#include "assets/synthetic/built_in_teeth.h"
#include "assets/tooth.h"

namespace app {

std::vector<CanalTooth> canalTeeth(const assets::JawParameters& jaw) {
  std::vector<CanalTooth> teeth;
  for (const int fdi : assets::builtInTeeth(jaw)) {
    const bool is_buried = assets::isThirdMolar(fdi) && jaw.depth_mm > 0.0;
    teeth.push_back({fdi, assets::canalsOf(assets::builtInTooth(jaw, fdi)),
                     is_buried ? fmt::format("impacted, {:g} mm under the occlusal plane", jaw.depth_mm) : ""});
  }
  return teeth;
}

std::string canalTable(const std::vector<CanalTooth>& teeth) {
  std::string text = fmt::format("{:<5} {:<14} {:>9} {:>12} {:>12} {:>9}  {}\n", "tooth", "canal", "length mm",
                                 "working l mm", "Schneider °", "width mm", "");
  for (const CanalTooth& tooth : teeth) {
    if (!tooth.canals) text += fmt::format("{:<5} {}\n", tooth.fdi, tooth.remark);
    if (!tooth.canals) continue;
    for (const assets::ToothCanal& canal : tooth.canals->canals) {
      std::string remark = tooth.canals->is_modelled ? "modelled" : "built-in";
      if (canal.joins) remark += ", joins the " + tooth.canals->canals[*canal.joins].name;
      if (!tooth.remark.empty()) remark += "; " + tooth.remark;
      text += fmt::format("{:<5} {:<14} {:>9.1f} {:>12.1f} {:>12.0f} {:>9.2f}  {}\n", tooth.fdi, canal.name,
                          canal.length_mm(), canal.workingLength_mm(), canal.schneider_rad * 180.0 / std::numbers::pi,
                          canal.smallestWidth_mm(), remark);
    }
  }
  return text;
}

}  // namespace app
