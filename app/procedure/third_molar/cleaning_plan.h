// The end of the shown operation: chips sucked away, the follicle scraped off, sharp edges filed, places of stitches
// confirmed; each planned from what is left and from the bone as it is when the one before has ended. Frame P, mm. Any
// thread, one at a time; some 0.1 s; the same site gives the same step.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/procedure/socket/sharp_edges.h"
#include "app/procedure/third_molar/operation_planner.h"
#include "app/procedure/third_molar/socket_reach.h"

namespace app {

/// What is left at the site.
struct SiteLeft {
  std::vector<glm::dvec3> chips_P_mm;              ///< loose, worth taking
  std::vector<glm::dvec3> stuck_P_mm, loose_P_mm;  ///< blobs of follicle
  std::vector<SharpEdge> edges;
  std::vector<glm::dvec3> stitches_P_mm;  ///< not made yet
};

class CleaningPlanner {
 public:
  /// Radius of each instrument's tip, by Cleaning; none: it is not in the tray.
  using Tips = std::array<std::optional<double>, kCleanings>;
  /// Unit: `out_P` out of the socket, `shaft_P` as an instrument lies clear of lip and teeth. `tongue_P_mm`: the jaw's
  /// outer surface there, as scanned, which no file opens.
  CleaningPlanner(const glm::dvec3& out_P, const glm::dvec3& shaft_P, const Tips& tips_mm,
                  std::vector<glm::dvec3> tongue_P_mm = {})
      : out_P_(out_P), shaft_P_(shaft_P), tips_mm_(tips_mm), tongue_P_mm_(std::move(tongue_P_mm)) {}

  /// `jaw`: in the order of the grid. None: nothing is left to do, or nothing that can be reached.
  std::optional<OperationStep> next(const SiteLeft& left, const assets::VolumeGrid& grid,
                                    const std::vector<std::uint8_t>& jaw);

 private:
  std::vector<CleaningPlace> placesFor(Cleaning what, const SiteLeft& left, const SocketReach& reach,
                                       double tip_mm) const;

  glm::dvec3 out_P_, shaft_P_;
  Tips tips_mm_;
  std::vector<glm::dvec3> tongue_P_mm_;
  std::size_t next_ = 0;  ///< of the round
};

}  // namespace app
