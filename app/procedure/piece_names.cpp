#include "app/procedure/piece_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace app {
namespace {

// Our defaults.
constexpr double kCrown = 0.7, kRoot = 0.15;     // of the enamel: at least, at most
constexpr double kAside = 0.35, kTurned = 0.35;  // of the way; rad: worth a word

std::string_view kindOf(const SeenPiece& piece) {
  if (!piece.enamel_share) return "part";
  return *piece.enamel_share >= kCrown ? "crown" : *piece.enamel_share <= kRoot ? "root" : "half";
}

/// On the side to which it lies farthest.
std::string_view sideOfPiece(const glm::dvec3& from_middle_mm, const ArchFrame& arch) {
  const std::array<std::pair<glm::dvec3, std::array<std::string_view, 2>>, 3> axes = {
      {{arch.distal_P, {"distal", "mesial"}}, {arch.buccal_P, {"buccal", "lingual"}}, {arch.up_P, {"upper", "lower"}}}};
  const auto along = [&](const auto& axis) { return glm::dot(from_middle_mm, axis.first); };
  const auto& most = *std::ranges::max_element(axes, {}, [&](const auto& axis) { return std::abs(along(axis)); });
  return most.second[along(most) > 0.0 ? 0 : 1];
}

}  // namespace

std::vector<std::string> pieceNames(std::span<const SeenPiece> pieces, const glm::dvec3& tooth_P_mm, bool is_whole,
                                    const std::optional<ArchFrame>& arch) {
  if (is_whole && pieces.size() == 1) return {"tooth"};
  std::vector<std::string> names;
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const std::string_view kind = kindOf(pieces[n]);
    const auto alike = std::ranges::count(pieces, kind, kindOf);
    if (!arch) {
      names.push_back(alike > 1 || kind == "part" ? fmt::format("piece {}", n + 1) : std::string(kind));
      continue;
    }
    // Two roots lie to either side of their own middle, not of the tooth's.
    glm::dvec3 middle_mm = tooth_P_mm;
    if (alike > 1) {
      middle_mm = glm::dvec3(0.0);
      for (const SeenPiece& one : pieces)
        if (kindOf(one) == kind) middle_mm += one.middle_P_mm / static_cast<double>(alike);
    }
    const bool has_side = alike > 1 || kind == "half" || kind == "part";
    names.push_back(has_side ? fmt::format("{} {}", sideOfPiece(pieces[n].middle_P_mm - middle_mm, *arch), kind)
                             : std::string(kind));
  }
  // Three halves: the third would have the name of one of the others.
  for (std::size_t n = 0; n < names.size(); ++n)
    if (std::ranges::count(names, names[n]) > 1 && !names[n].starts_with("piece "))
      names[n] = fmt::format("{} {}", names[n], n + 1);
  return names;
}

std::string liftInWords(const glm::dvec3& by_P_mm, double turned_rad, const ArchFrame& arch) {
  const double length_mm = glm::length(by_P_mm);
  if (!(length_mm > 0.0)) return "";
  const auto share = [&](const glm::dvec3& axis) { return glm::dot(by_P_mm, axis) / length_mm; };
  const double back = share(arch.distal_P), to_cheek = share(arch.buccal_P);
  std::string words = "up";
  if (std::abs(back) >= kAside && std::abs(back) >= std::abs(to_cheek))
    words += back > 0.0 ? " and back" : " and forward";
  else if (std::abs(to_cheek) >= kAside)
    words += to_cheek > 0.0 ? " and to the cheek" : " and to the tongue";
  return turned_rad >= kTurned ? words + ", turning it" : words;
}

}  // namespace app
