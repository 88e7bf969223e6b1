// What a person says of a jaw that was found in a scan: edits of the automatic result, in the order given; teeth and
// canals by points clicked in it, then voxels by brush and scissors. Frame P, mm. Plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>
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

/// What voxels are painted as, where it is no FDI number.
inline constexpr std::uint8_t kPaintNothing = 0, kPaintBone = 1;
inline constexpr double kLeastBrush_mm = 0.5, kMostBrush_mm = 5.0;

/// A ball moved through the scan.
struct BrushStroke {
  std::vector<glm::dvec3> way_P_mm;  ///< of its centre; one point is a dab
  double radius_mm = 1.5;
  std::uint8_t as = kPaintNothing;              ///< FDI number, kPaintBone or kPaintNothing
  double low_hu = -32768.0, high_hu = 32767.0;  ///< voxels of other grey values stay

  friend bool operator==(const BrushStroke&, const BrushStroke&) = default;
};

/// Nothing of the jaw lies beyond this line, as wide as it is long and kCutDepth_mm to both sides of where it was
/// drawn.
struct JawCut {
  glm::dvec3 from_P_mm{0.0}, to_P_mm{0.0};
  glm::dvec3 beyond_P_mm{0.0};  ///< a point of what goes

  friend bool operator==(const JawCut&, const JawCut&) = default;
};
inline constexpr double kCutDepth_mm = 20.0;

using VoxelEdit = std::variant<BrushStroke, JawCut>;

struct JawClicks {
  std::vector<ToothClick> teeth;
  /// Each from one end of a mandibular canal to the other, kLeast… to kMostCanalClicks points.
  std::vector<std::vector<glm::dvec3>> canals;
  std::vector<VoxelEdit> voxels{};  ///< after all else (voxel_edits.h)

  bool isEmpty() const { return teeth.empty() && canals.empty() && voxels.empty(); }
  friend bool operator==(const JawClicks&, const JawClicks&) = default;
};

}  // namespace assets
