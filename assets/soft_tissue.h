// The table of soft tissues that an instrument can touch: values in fields and ticks, names for people. Summary,
// metrics, events and the head-up line are made from it. They are surfaces that are drawn, not voxels of the scan
// (tissue.h). Plain data; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace assets {

/// The values are stored in sessions.
enum class SoftTissue : std::uint8_t { none = 0, gingiva = 1, flap = 2, lip = 3, cheek = 4, tongue = 5, mucosa = 6 };
inline constexpr std::size_t kSoftTissueCount = 7;

struct SoftTissueProperties {
  std::string_view key;   ///< in files
  std::string_view name;  ///< for people
};

inline constexpr std::array<SoftTissueProperties, kSoftTissueCount> kSoftTissues = {{
    {"none", "none"},
    {"gingiva", "gingiva"},
    {"flap", "flap"},
    {"lip", "lip"},
    {"cheek", "cheek"},
    {"tongue", "tongue"},
    {"mucosa", "oral mucosa"},
}};

constexpr const SoftTissueProperties& properties(SoftTissue tissue) {
  const auto n = static_cast<std::size_t>(tissue);
  return kSoftTissues[n < kSoftTissueCount ? n : 0];
}

/// The bit of a tissue in a set of tissues.
constexpr std::uint8_t bitOf(SoftTissue tissue) {
  return tissue == SoftTissue::none ? std::uint8_t{0} : static_cast<std::uint8_t>(1u << static_cast<unsigned>(tissue));
}
constexpr bool contains(std::uint8_t tissues, SoftTissue tissue) { return (tissues & bitOf(tissue)) != 0; }

}  // namespace assets
