// A carious lesion placed into a tooth by rule, to be excavated: through the enamel of a fissure or of a side at the
// contact, along the dentine's border, and as a cone towards the pulp: soft (infected) inside, firm (affected) around
// it, sound dentine left over the pulp. Sizes are usual teaching, not one patient's (enamel cone and spread at the
// border: Kidd and Fejerskov, Dental Caries; not verified). Tooth frame, mm. Changes labels and grey values alone.
// Start-up only; some 0.2 s.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/tooth_canals.h"

namespace app {

enum class CariesSite { occlusal, mesial, distal };

/// "occlusal, mesial, distal"; none: another word.
std::optional<CariesSite> cariesSiteOf(std::string_view name);
std::vector<std::string> cariesSites();

/// `ct`: a tooth with its tissues, its neighbours other_teeth. Throws UsageError, beginning with `option`, where no
/// dentine lies under the enamel there, or too little over the pulp.
void placeCaries(assets::CtVolume& ct, const assets::ToothFrame& frame, CariesSite site, const std::string& option);

}  // namespace app
