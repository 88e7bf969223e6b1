// The end of the shown operation: chips sucked away, the follicle scraped off, sharp edges filed, places of stitches
// confirmed; each planned from what is left when the one before has ended. Frame P, mm. Pure; microseconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/procedure/socket/sharp_edges.h"
#include "app/procedure/third_molar/operation_planner.h"

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
  /// `out_P`: unit, out of the socket. `has`: instruments of the tray, by Cleaning.
  CleaningPlanner(const glm::dvec3& out_P, const std::array<bool, kCleanings>& has) : out_P_(out_P), has_(has) {}

  /// None: nothing is left to do, or nothing that can be done.
  std::optional<OperationStep> next(const SiteLeft& left);

 private:
  std::optional<CleaningStep> stepOf(Cleaning what, const SiteLeft& left) const;

  glm::dvec3 out_P_;
  std::array<bool, kCleanings> has_;
  std::size_t next_ = 0;  ///< of the round
};

}  // namespace app
