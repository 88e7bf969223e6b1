// What the bur of a recorded session had to keep off, from the labels, teeth and site that the session holds. Sessions
// recorded before teeth and site were stored: of a built-in case they are made again; else the canal alone is known.
// Frame P. Commands; from the cache where it can be.
#pragma once

#include "app/session/session_start.h"
#include "assets/patient.h"
#include "assets/risk_structures.h"

namespace app {

/// `within`: patientWithinSession(start).
assets::RiskStructures risksOfSession(const StoredStart& start, const assets::Patient& within);

}  // namespace app
