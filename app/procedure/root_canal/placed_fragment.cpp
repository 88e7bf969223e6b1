#include "app/procedure/root_canal/placed_fragment.h"

#include <cmath>

#include <fmt/core.h>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {

std::vector<PlacedFragment> placed(const assets::ToothCanals& tooth, std::span<const assets::MetalFragment> fragments) {
  std::vector<PlacedFragment> all;
  for (const assets::MetalFragment& fragment : fragments) {
    PlacedFragment& one = all.emplace_back();
    one.size = fragment.size;
    one.nickel_titanium = fragment.nickel_titanium;
    one.length_mm = fragment.length_mm();
    const auto tip = canalTip(tooth, fragment.tip_P_mm());
    if (!tip) continue;
    const assets::ToothCanal& canal = tooth.canals[tip->canal];
    one.canal = canal.name;
    one.from_foramen_mm = canal.length_mm() - tip->along_mm;
  }
  return all;
}

std::string inWords(const PlacedFragment& fragment) {
  std::string words = fmt::format("{:.1f} mm of a {}#{}", fragment.length_mm,
                                  fragment.nickel_titanium ? "nickel-titanium " : "", fragment.size);
  if (fragment.canal.empty()) return words + " outside the canals";
  return words + fmt::format(" in the {} canal, its tip {:.1f} mm {} the foramen", fragment.canal,
                             std::fabs(fragment.from_foramen_mm), fragment.from_foramen_mm < 0.0 ? "beyond" : "from");
}

}  // namespace app
