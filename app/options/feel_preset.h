// A whole feel by one name: the force law of another simulator with the numbers its authors published, so that a study
// can be run again on it. `density-weighted`: law `points`, whose stiffness is that of cortical bone times the mean
// density over the last 100 ticks (reference/physics 1.4), with the density levels air 0, pulp 100, dentine 150 and
// enamel 255 of 255 (levels of the published volumes; that they are the stiffness is an inference). Start-up only.
#pragma once

#include <string>
#include <vector>

#include "haptics/contact/law_settings.h"

namespace app {

/// "density-weighted"
std::vector<std::string> feelPresets();

/// `name` is one of them.
void useFeelPreset(const std::string& name, haptics::LawSettings& law);

}  // namespace app
