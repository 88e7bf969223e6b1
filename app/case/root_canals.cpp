#include "app/case/root_canals.h"

#include <array>
#include <numbers>

#include <fmt/core.h>

#include "assets/import/modelled_canals.h"
#include "assets/load_error.h"
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

std::vector<CanalTooth> canalTeeth(const assets::CtVolume& ct) {
  std::array<bool, 256> is_there{};
  for (const std::uint8_t fdi : ct.tooth) is_there[fdi] = true;
  std::vector<CanalTooth> teeth;
  for (int fdi = 1; fdi < 256; ++fdi) {
    if (!is_there[static_cast<std::size_t>(fdi)]) continue;
    CanalTooth tooth{fdi, std::nullopt, ""};
    try {
      tooth.canals = assets::modelledCanals(ct, fdi);
    } catch (const assets::LoadError& refused) {
      tooth.remark = refused.what();
    }
    teeth.push_back(std::move(tooth));
  }
  return teeth;
}

std::unique_ptr<assets::ToothSampler> fineTooth(const assets::CtVolume& ct,
                                                const std::optional<assets::JawParameters>& jaw,
                                                const assets::ToothCanals& canals, double spacing_mm) {
  if (jaw) return assets::fineBuiltInTooth(assets::builtInTooth(*jaw, canals.fdi), ct, spacing_mm);
  return assets::fineScannedTooth(ct, canals, spacing_mm);
}

std::string canalTable(const std::vector<CanalTooth>& teeth) {
  std::string text = fmt::format("{:<5} {:<14} {:>9} {:>12} {:>12} {:>9}  {}\n", "tooth", "canal", "length mm",
                                 "working l mm", "Schneider °", "width mm", "");
  for (const CanalTooth& tooth : teeth) {
    if (!tooth.canals) {
      text += tooth.remark + "\n";
      continue;
    }
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
