// Looks for what still holds a piece of tooth together where it is being sectioned (bridge.h): outside a region around
// the cut it falls into parts; a bridge is the least area that separates two of them (minimum cut). Frame and mm of the
// grid. One thread, not the servo's; allocates; some ms with cells of 0.3 mm.
// Area: length of the vector area |sum n s^2|, true for a plane cut in any direction, where the number of faces is up
// to 1.73 times too large. Faces count by the smaller solid fraction of their two voxels, those along the rim too.
// width = sqrt(12 I_v / A), thickness = sqrt(12 I_u / A), exact for a rectangle. Source: reference/extraction 2.4.
// More than two parts: those on one side of a flat cut against those on the other; else each but the largest against
// all others (isolating cuts, Dahlhaus et al., SIAM J. Comput. 23, 1994).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "haptics/body/bridge.h"
#include "haptics/body/components.h"
#include "haptics/body/grid_min_cut.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

inline constexpr double kBridgeCell_mm = 0.3;    ///< while the bur works
inline constexpr double kLeastPart_mm3 = 5.0;    ///< smaller ones are no part that a bridge holds
inline constexpr double kRegionMargin_mm = 1.5;  ///< of the region around a cut
inline constexpr std::size_t kMaxParts = 4;      ///< the largest

struct PartOfPiece {
  double volume_mm3 = 0.0;      ///< outside the region
  glm::dvec3 centroid_mm{0.0};  ///< of that
};

/// Where a bridge is looked for.
struct CutRegion {
  VoxelBox box;  ///< within the grid
  /// Not 0: belongs to it; voxels of the box, i fastest. Empty: all do.
  std::vector<std::uint8_t> zone;
  /// Across a flat cut, through its centre: parts beyond either side are held together by one bridge. 0: not flat.
  glm::dvec3 normal{0.0}, centre_mm{0.0};
};

class BridgeSearch {
 public:
  /// In cells of whole voxels, the size nearest to `cell_mm` but at least one. The components, which must be joined,
  /// must outlive the search and stay as they are.
  BridgeSearch(const Components& components, std::size_t piece, CutRegion region, double cell_mm);

  /// The largest first; fewer than two: the piece is not cut through to the region's faces, and there is no bridge.
  std::span<const PartOfPiece> parts() const { return parts_; }
  std::span<const Bridge> bridges() const { return bridges_; }

 private:
  /// Two voxels on either side of the cut, the first on the first side.
  struct CutFace {
    glm::ivec3 first{0}, second{0};
  };
  struct Side {
    std::vector<bool> cell;  ///< on the first side
    std::vector<CutFace> faces;
  };
  void divideOutside();
  void fillRegion();
  void linkCells(GridMinCut& graph) const;
  /// By part: cells in which it meets the region.
  std::vector<std::vector<glm::ivec3>> terminals() const;
  using Group = std::vector<bool>;  ///< by part: comes off
  std::vector<Group> groups() const;
  void separate();
  Side sideOf(const GridMinCut& graph) const;
  Bridge measured(const Side& side) const;
  std::size_t partBeyond(const Side& side, const Group& group) const;

  bool isInRegion(glm::ivec3 ijk) const {
    return glm::all(glm::greaterThanEqual(ijk, box().first)) && glm::all(glm::lessThanEqual(ijk, box().last)) &&
           (region_.zone.empty() || region_.zone[local(ijk)] != 0);
  }
  const VoxelBox& box() const { return region_.box; }
  BrickMask regionIn(glm::ivec3 corner) const;
  std::size_t local(glm::ivec3 ijk) const { return assets::indexIn(box().last - box().first + 1, ijk - box().first); }
  bool isMine(glm::ivec3 ijk) const { return isInRegion(ijk) && mine_[local(ijk)]; }
  glm::ivec3 cellOf(glm::ivec3 ijk) const { return (ijk - box().first) / cell_; }
  bool isFirst(const Side& side, glm::ivec3 ijk) const { return side.cell[assets::indexIn(cells_, cellOf(ijk))]; }
  /// parts_.size(): none.
  std::size_t outsidePart(glm::ivec3 ijk) const;
  /// visit(voxel, next voxel along axis, axis) over the pairs of solid voxels in different cells.
  template <class Visit>
  void forLinkedFaces(const Visit& visit) const;

  const Components& components_;
  std::size_t piece_;
  CutRegion region_;
  int cell_;
  glm::ivec3 cells_{0};
  std::vector<std::vector<BrickPart>> outside_;
  PartJoin outside_join_;
  std::vector<std::size_t> part_of_root_;  ///< parts_.size(): none
  std::vector<PartOfPiece> parts_;
  std::vector<bool> mine_;  ///< solid voxels of the piece in the region
  std::vector<Bridge> bridges_;
};

}  // namespace haptics
