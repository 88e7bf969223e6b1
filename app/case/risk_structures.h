// What a bur must keep off, by distance: mandibular canal, outer lingual surface of the jaw, second molar, and the band
// in which the lingual nerve runs, which no scan shows: modelled. From the labels as scanned; a structure that a case
// does not have is empty. Frame P, mm. Start-up and commands; 1.2 s of CPU for the built-in patient.
// Definitions: reference/product 3.2.
#pragma once

#include <array>
#include <string_view>

#include "assets/patient.h"
#include "assets/structure_distance.h"

namespace app {

enum class RiskStructure { canal, lingual, second_molar, lingual_nerve };
inline constexpr std::size_t kRiskStructures = 4;

struct RiskText {
  std::string_view key;   ///< in files
  std::string_view name;  ///< for people
};
/// In the order of RiskStructure.
inline constexpr std::array<RiskText, kRiskStructures> kRiskTexts{{{"canal", "canal"},
                                                                   {"lingual", "lingual plate"},
                                                                   {"second_molar", "second molar"},
                                                                   {"lingual_nerve", "lingual nerve (modelled)"}}};

struct RiskStructures {
  std::array<assets::StructureDistance, kRiskStructures> distance;

  const assets::StructureDistance& of(RiskStructure structure) const {
    return distance[static_cast<std::size_t>(structure)];
  }
  std::size_t bytes() const;
};

/// To be incremented with any change of the definitions below.
inline constexpr int kRiskStructuresRevision = 1;

/// The voxels of one, not 0 inside, in the order of the patient's grid; empty: the case has none.
///   canal         labelled as such, or the tube about its centre line
///   lingual       what lies beyond the outer surface of bone, seen from it towards the tongue: 12 mm deep, from 20 mm
///                 before to 20 mm behind the operated tooth; nothing where a root lies bare
///   second_molar  the tooth before the operated third molar
///   lingual_nerve two standard deviations about where 669 nerves lay at the third molar: 2.06 ± 1.10 mm off the plate,
///                 3.01 ± 0.42 mm below the crest; from 12 mm before to 12 mm behind the tooth
std::vector<std::uint8_t> voxelsOf(RiskStructure structure, const assets::Patient& patient);

/// Reads grid, labels, numbers of the teeth, site and canal of the patient.
RiskStructures riskStructures(const assets::Patient& patient);

}  // namespace app
