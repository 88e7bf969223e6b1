// What a measured preparation has to be painted on the live tooth: its distance to the ideal, what is undercut along
// the way of insertion, and that way as an arrow onto the stump. Made beside the measure, on its thread, some 50 ms.
// Frame P, mm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/procedure/preparation/tooth_paint.h"
#include "render/frame.h"

namespace app {

struct PreparationPaint {
  assets::VolumeGrid box;                   ///< of the spots
  PaintSpots deviation, undercut;           ///< undercut: crowns with walls
  std::optional<render::GuideArrow> arrow;  ///< alike
  std::string way;                          ///< "way of insertion 2.4° off the axis"; empty: none
  std::string hindered;                     ///< "undercut 0.13 mm³"; empty: none
};

PreparationPaint preparationPaint(const PreparationMeasure& measure, const BoxBytes& made,
                                  const PreparationOutcomes& outcomes);

/// Where an ideal by rule begins on the tooth's surface, as a line drawn on it. Some 0.2 s.
PaintSpots outlineSpots(const Crown& crown, const PreparedIdeal& ideal);

/// Lines of the legend.
std::vector<render::SurfacePaint::Row> outlineRows();
std::vector<render::SurfacePaint::Row> deviationRows();
std::vector<render::SurfacePaint::Row> insertionRows(const PreparationPaint& paint);

}  // namespace app
