// The case of a recorded session as its measures need it: what the bur had to keep off, from the labels, teeth and site
// that the session holds, and what was to be removed: the gutter as it would be planned again, or the target of a
// practice block. Sessions recorded before teeth and site were stored: of a built-in case they are made again; else the
// canal alone is known. Frame P. Commands; from the cache where it can be, and some tenths of a second for the plan.
#pragma once

#include "app/session/measures/session_case.h"
#include "app/session/session_start.h"

namespace app {

SessionCase caseOfSession(const StoredStart& start);
/// With its structures as risksOfSession() gives them, for who has them.
SessionCase caseOfSessionWith(const StoredStart& start, const assets::RiskStructures& risks);

}  // namespace app
