// A patient's risk structures, computed once and kept in the user's cache under the fingerprint of its labels, teeth,
// site and canal. A file that is damaged or foreign is made again and never used; a cache that cannot be written costs
// the time again. Frame P. Start-up and commands; about 50 ms from the cache, else as riskStructures().
#pragma once

#include <cstdint>

#include "app/case/risk_structures.h"

namespace app {

/// Of everything that riskStructures() reads.
std::uint64_t riskFingerprint(const assets::Patient& patient);

assets::RiskStructures cachedRiskStructures(const assets::Patient& patient);

}  // namespace app
