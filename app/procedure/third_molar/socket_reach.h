// Where the round tip of a straight instrument can be in a socket as it is now, and from which direction: tip and shank
// clear of bone and teeth all the way in. Frame P, mm. Pure once made; making it 0.1 s, a place some ms; allocates.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "haptics/body/distance_field.h"

namespace app {

/// The middle of the tip, and the way to the handle.
struct TipPlace {
  glm::dvec3 at_P_mm{0.0};
  glm::dvec3 shaft_P{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 wall_P{0.0};             ///< unit, from the nearest wall to the tip
  double wall_mm = 0.0;               ///< of the middle, to that wall
};

class SocketReach {
 public:
  /// Borrows `solid`, in the order of the grid: all that an instrument meets. Tips are led within kSeen_mm of
  /// `middle_P_mm`, shanks go on. `out_P`: unit, the middle of all ways in.
  SocketReach(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& solid, const glm::dvec3& middle_P_mm,
              const glm::dvec3& out_P);
  static constexpr double kSeen_mm = 20.0;

  /// Ways in, the straightest first; unit.
  const std::vector<glm::dvec3>& shafts_P() const { return shafts_P_; }
  TipPlace placeAt(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P) const;
  /// With a tip and a shank of this radius, from there outwards; the tip may be `sunk_mm` in.
  bool isFree(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P, double radius_mm, double sunk_mm = 0.05) const;
  /// Nothing solid between two places.
  bool isOpen(const glm::dvec3& from_P_mm, const glm::dvec3& to_P_mm) const;

  /// Places of a tip of `radius_mm` that are free, not farther than `most_wall_mm` from a wall beyond touching it, and
  /// within `reach_mm` of one of the `goals`; each with the goals for which is_reached(place, goal) is true, chosen so
  /// that few places do for all. What no place reaches is left out.
  using IsReached = std::function<bool(const TipPlace& place, const glm::dvec3& goal_P_mm)>;
  struct Chosen {
    TipPlace place;
    std::vector<std::size_t> goals;
  };
  std::vector<Chosen> fewestFor(const std::vector<glm::dvec3>& goals_P_mm, double radius_mm, double reach_mm,
                                double most_wall_mm, const IsReached& is_reached) const;

 private:
  bool isShankFree(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P, double radius_mm) const;

  assets::VolumeGrid grid_;
  const std::vector<std::uint8_t>& solid_;
  haptics::DistanceField field_;
  std::vector<glm::dvec3> shafts_P_;
};

}  // namespace app
