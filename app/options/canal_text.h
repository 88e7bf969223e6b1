// Root canals as text: `straight:D[,L]` a tube of diameter D, `arc:R,ANGLE[,D]` 8 mm straight, an arc of radius R over
// ANGLE degrees, 2 mm straight, of diameter D or from 0.60 at the orifice to 0.25 at the apex, `builtin:TOOTH:NAME` one
// of the built-in teeth, as molar teeth lists them. mm. Start-up only. Throws UsageError with the accepted forms.
#pragma once

#include <string>

#include "assets/synthetic/root_canal.h"

namespace app {

/// "straight:D[,L], arc:R,ANGLE[,D] or builtin:TOOTH:NAME"
std::string canalForms();

assets::RootCanal canalFrom(const std::string& text);

}  // namespace app
