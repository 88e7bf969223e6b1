// What a person says of a jaw that was found in a scan, as points clicked in it: edits of the automatic result, in the
// order given. Frame P, mm. Plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

enum class ToothEdit : std::uint8_t {
  same_tooth,  ///< two pieces are one tooth
  two_teeth,   ///< one piece is two teeth
  number,      ///< the piece has this FDI number
  no_tooth,    ///< the piece is none
  root_tip     ///< the tip of a root that was not found
};
inline constexpr std::array<std::string_view, 5> kToothEdits = {"same-tooth", "two-teeth", "number", "no-tooth",
                                                                "root-tip"};
constexpr std::size_t pointsOf(ToothEdit edit) {
  return edit == ToothEdit::same_tooth || edit == ToothEdit::two_teeth ? 2 : 1;
}

struct ToothClick {
  ToothEdit edit = ToothEdit::number;
  std::array<glm::dvec3, 2> at_P_mm{};  ///< pointsOf() of them
  int fdi = 0;                          ///< of `number`

  friend bool operator==(const ToothClick&, const ToothClick&) = default;
};

inline constexpr std::size_t kLeastCanalClicks = 2, kMostCanalClicks = 6;

struct JawClicks {
  std::vector<ToothClick> teeth;
  /// Each from one end of a mandibular canal to the other, kLeast… to kMostCanalClicks points.
  std::vector<std::vector<glm::dvec3>> canals;

  bool isEmpty() const { return teeth.empty() && canals.empty(); }
};

}  // namespace assets
