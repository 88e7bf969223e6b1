#include "app/options/feel_preset.h"

#include <cassert>

namespace app {

std::vector<std::string> feelPresets() { return {"density-weighted"}; }

void useFeelPreset([[maybe_unused]] const std::string& name, haptics::LawSettings& law) {
  assert(name == feelPresets().front());
  using assets::Tissue;
  const auto density = [&](Tissue tissue, double level) {
    law.tissue.factor[static_cast<std::size_t>(tissue)] = level / 255.0;
  };
  law.kind = haptics::LawKind::points;
  density(Tissue::enamel, 255.0);
  density(Tissue::dentine, 150.0);
  density(Tissue::pulp, 100.0);
  density(Tissue::caries_soft, 0.25 * 150.0);
  density(Tissue::caries_firm, 0.6 * 150.0);
}

}  // namespace app
