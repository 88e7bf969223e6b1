// What a surgeon drew on bone and tooth before cutting, and how the cut compares with it, as events of a recording: the
// trough's line on the bone, the section's on the tooth. The last event of each kind stands for the session. Frame P,
// mm. Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace app {

/// Kinds of these events.
inline constexpr char kDrawnPlanEvent[] = "drawn plan", kDrawnCutEvent[] = "drawn plan cut";

enum class DrawnLine : std::uint8_t { trough, section };
inline constexpr std::size_t kDrawnLines = 2;
inline constexpr std::array<std::string_view, kDrawnLines> kDrawnLineNames = {"trough", "section"};
inline constexpr std::size_t kMostDrawnPoints = 200;  ///< of a line

struct DrawnPlan {
  std::array<std::vector<glm::dvec3>, kDrawnLines> line_P_mm;

  std::vector<glm::dvec3>& operator[](DrawnLine which) { return line_P_mm[static_cast<std::size_t>(which)]; }
  const std::vector<glm::dvec3>& operator[](DrawnLine which) const {
    return line_P_mm[static_cast<std::size_t>(which)];
  }
  bool isEmpty() const { return line_P_mm[0].empty() && line_P_mm[1].empty(); }
  bool operator==(const DrawnPlan&) const = default;
};
double lengthOf_mm(const std::vector<glm::dvec3>& line_P_mm);

std::string drawnPlanText(const DrawnPlan& plan);
/// None of other words, and of places that are not finite or too many.
std::optional<DrawnPlan> drawnPlanFrom(const std::string& text);

/// How what was removed lies to a line, seen along the way into the bone.
struct DrawnCut {
  double length_mm = 0.0;       ///< of the line
  double followed_share = 0.0;  ///< of it, under which something was removed
  double removed_mm3 = 0.0;     ///< bone for the trough, tooth for the section
  double beside_mm3 = 0.0;      ///< of that, farther to the side than a bur explains
  double off_mm = 0.0;          ///< mean distance to the side of what was removed

  bool operator==(const DrawnCut&) const = default;
};
/// None: no such line was drawn.
using DrawnComparison = std::array<std::optional<DrawnCut>, kDrawnLines>;

std::string drawnCutText(const DrawnComparison& comparison);
std::optional<DrawnComparison> drawnCutFrom(const std::string& text);
/// "trough: 84 % of 15 mm followed, 12 of 96 mm³ beside it; section: …"; empty: none was drawn.
std::string drawnCutInWords(const DrawnComparison& comparison);

}  // namespace app
