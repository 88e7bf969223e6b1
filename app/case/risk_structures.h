// What a bur must keep off, by distance: mandibular canal, outer lingual surface of the jaw, second molar, and the band
// in which the lingual nerve runs, which no scan shows: modelled. From the labels as scanned; a structure that a case
// does not have is empty. Frame P, mm. Start-up and commands; 1.2 s of CPU for the built-in patient.
// Definitions: reference/product 3.2.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/patient.h"
#include "assets/risk_structures.h"

namespace app {

/// To be incremented with any change of the definitions below.
inline constexpr int kRiskStructuresRevision = 2;

/// The voxels of one, not 0 inside, in the order of the patient's grid; empty: the case has none.
///   canal         labelled as such, or the tube about its centre line
///   lingual       what lies beyond the outer surface of bone where that faces the tongue, within 53°: 12 mm deep, from
///                 20 mm before to 20 mm behind the operated tooth; nothing where a root lies bare
///   second_molar  the tooth before the operated third molar
///   lingual_nerve two standard deviations about where 669 nerves lay at the third molar: 2.06 ± 1.10 mm off the plate,
///                 3.01 ± 0.42 mm below the crest; from 12 mm before to 12 mm behind the tooth
std::vector<std::uint8_t> voxelsOf(assets::RiskStructure structure, const assets::Patient& patient);

/// Reads grid, labels, numbers of the teeth, site and canal of the patient.
assets::RiskStructures riskStructures(const assets::Patient& patient);

}  // namespace app
