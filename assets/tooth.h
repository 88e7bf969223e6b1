// FDI tooth numbers (ISO 3950): quadrant, then position from the midline. Permanent teeth 11..18, 21..28, 31..38,
// 41..48; primary teeth 51..55, 61..65, 71..75, 81..85. Right and left are the patient's. Directions in frame P (LPS),
// unit, are the mean tangents of a normal arch, not measurements. Pure functions; any thread.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace assets {

/// Albedo of enamel in linear light, for the teeth of a scan and of a face mesh alike: one arch has one colour.
inline constexpr glm::vec3 kEnamelAlbedo{0.70f, 0.65f, 0.53f};

constexpr int quadrantOf(int fdi) { return fdi / 10; }
/// From the midline, 1 is the central incisor.
constexpr int positionOf(int fdi) { return fdi % 10; }
constexpr bool isPrimaryTooth(int fdi) { return quadrantOf(fdi) >= 5; }
constexpr bool isToothNumber(int fdi) {
  return fdi >= 11 && quadrantOf(fdi) <= 8 && positionOf(fdi) >= 1 && positionOf(fdi) <= (isPrimaryTooth(fdi) ? 5 : 8);
}
constexpr bool isUpper(int fdi) { return quadrantOf(fdi) % 4 == 1 || quadrantOf(fdi) % 4 == 2; }
constexpr bool isRight(int fdi) { return quadrantOf(fdi) % 4 <= 1; }
constexpr bool isThirdMolar(int fdi) { return isToothNumber(fdi) && positionOf(fdi) == 8; }

/// "lower right third molar", "upper left primary canine".
inline std::string toothName(int fdi) {
  constexpr std::array<std::string_view, 9> kPermanent{"",
                                                       "central incisor",
                                                       "lateral incisor",
                                                       "canine",
                                                       "first premolar",
                                                       "second premolar",
                                                       "first molar",
                                                       "second molar",
                                                       "third molar"};
  constexpr std::array<std::string_view, 6> kPrimary{"",       "central incisor", "lateral incisor",
                                                     "canine", "first molar",     "second molar"};
  if (!isToothNumber(fdi)) return "no tooth";
  const auto position = static_cast<std::size_t>(positionOf(fdi));
  return std::string(isUpper(fdi) ? "upper " : "lower ") + (isRight(fdi) ? "right " : "left ") +
         (isPrimaryTooth(fdi) ? "primary " + std::string(kPrimary[position]) : std::string(kPermanent[position]));
}

/// Towards the other jaw.
inline glm::dvec3 occlusalDirection_P(int fdi) { return {0.0, 0.0, isUpper(fdi) ? -1.0 : 1.0}; }

/// From the tongue to lip or cheek: forward at the incisors, sideways and a little forward at the molars.
inline glm::dvec3 buccalDirection_P(int fdi) {
  constexpr std::array<glm::dvec2, 9> kOutwardForward{{{0.97, 0.25},
                                                       {0.15, 0.99},
                                                       {0.4, 0.92},
                                                       {0.7, 0.71},
                                                       {0.87, 0.5},
                                                       {0.92, 0.4},
                                                       {0.95, 0.3},
                                                       {0.97, 0.25},
                                                       {0.97, 0.25}}};
  const glm::dvec2 way = kOutwardForward[static_cast<std::size_t>(positionOf(fdi)) % kOutwardForward.size()];
  return glm::normalize(glm::dvec3(isRight(fdi) ? -way.x : way.x, -way.y, 0.0));
}

}  // namespace assets
