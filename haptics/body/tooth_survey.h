// What a tooth has come apart into, and what still holds it, while it is cut: pieces, chips, bridges. Frame and mm of
// the tooth's grid. One thread, not the servo's; 1 us a changed brick, 20-90 us to join, 1-10 ms for bridges;
// allocates. The findings depend on the bytes alone, not on when or in which order they came.
// The cut is where the tooth was solid at first and is not any more: first its largest connected place, then all of it,
// each in a box along its principal axes with kRegionMargin_mm around it: beyond an upright box an oblique slot's
// blocks stand out as corners. A flat cut's box, at least twice as deep as thick, goes on through the tooth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "haptics/body/bridge_search.h"
#include "haptics/body/components.h"

namespace haptics {

inline constexpr std::size_t kMostPieces = 8;  ///< that are listed

/// Crosses threads: owns nothing.
struct ToothFindings {
  std::size_t pieces = 0;  ///< of kLeastPiece_mm3 and more; may exceed kMostPieces
  std::array<ToothPiece, kMostPieces> piece{};
  std::size_t chips = 0;
  double chips_mm3 = 0.0;
  double cut_mm3 = 0.0;  ///< solid that is gone
  struct Held {
    std::size_t parts = 0;  ///< fewer than two: this piece is not cut through to a bridge
    std::array<PartOfPiece, kMaxParts> part{};
    std::size_t bridges = 0;
    std::array<Bridge, kMaxParts - 1> bridge{};
  };
  std::array<Held, kMostPieces> held{};  ///< by piece
};
static_assert(std::is_trivially_destructible_v<ToothFindings>);

class ToothSurvey {
 public:
  /// `solid` in the order of the grid: the tooth that counts as whole.
  ToothSurvey(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);

  void update(glm::ivec3 brick, std::span<const std::uint8_t, 512> solid) { components_.update(brick, solid); }
  /// Joins; pieces and chips, without bridges.
  ToothFindings pieces();
  /// Of the pieces found last.
  void findBridges(ToothFindings& findings, double cell_mm) const;

  const Components& components() const { return components_; }

 private:
  std::vector<CutRegion> cutRegions(double& cut_mm3) const;

  Components components_;
  std::vector<BrickMask> uncut_;
};

}  // namespace haptics
