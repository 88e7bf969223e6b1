// What a bur must keep off: the structures, their names and the bands of distance in which people are warned
// (reference/product 3.2; where it gives one bound the others are our defaults), and where they lie in one patient.
// Plain immutable data; any thread but the servo.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "assets/structure_distance.h"

namespace assets {

enum class RiskStructure : std::uint8_t { canal, lingual, second_molar, lingual_nerve };
inline constexpr std::size_t kRiskStructures = 4;

struct RiskText {
  std::string_view key;              ///< in files
  std::string_view name;             ///< for people
  double red_mm, amber_mm, note_mm;  ///< nearer than; touching is red
};
/// In the order of RiskStructure. No scan shows the lingual nerve: it is always called modelled.
inline constexpr std::array<RiskText, kRiskStructures> kRiskTexts{
    {{"canal", "canal", 1.0, 2.0, 4.0},
     {"lingual", "lingual plate", 0.0, 1.0, 2.0},
     {"second_molar", "second molar", 0.0, 0.5, 1.0},
     {"lingual_nerve", "lingual nerve (modelled)", 0.0, 0.0, 2.0}}};

enum class RiskLevel : std::uint8_t { none, note, amber, red };
constexpr RiskLevel riskLevel(std::size_t structure, double mm) {
  const RiskText& text = kRiskTexts[structure];
  return mm <= 0.0 || mm < text.red_mm ? RiskLevel::red
         : mm < text.amber_mm          ? RiskLevel::amber
         : mm < text.note_mm           ? RiskLevel::note
                                       : RiskLevel::none;
}

struct RiskStructures {
  std::array<StructureDistance, kRiskStructures> distance;  ///< empty: the case has none

  const StructureDistance& of(RiskStructure structure) const { return distance[static_cast<std::size_t>(structure)]; }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const StructureDistance& one : distance) sum += one.bytes();
    return sum;
  }
};

}  // namespace assets
