// What the access cavity of a tooth has come to (reference/sisters 4): roof removed and overhang, outline against the
// ideal, tissue lost, floor gouged, straight-line access to a canal, depth. From the field before, with its tissues,
// and after. Frame P, mm, rad. Pure; any thread; some 0.1 s each.
#pragma once

#include <span>

#include "app/procedure/root_canal/tooth_blocks.h"
#include "assets/tooth_canals.h"

namespace app {

/// Over the outline of the chamber, straight up.
struct RoofOutcome {
  double removed = 0.0;       ///< share that is open to above
  double overhang_mm2 = 0.0;  ///< the rest
  double overhang_mm3 = 0.0;  ///< tooth there within 1 mm over the roof
};
RoofOutcome roofOutcome(const FineSolid& after, const assets::ToothCanals& tooth);

/// Half a millimetre over the roof, what is open (also what was before the session) against what files and pulp need:
/// the hull of all orifices with 0.5 mm around, and all of the chamber.
struct OutlineOutcome {
  double ideal_mm2 = 0.0, opened_mm2 = 0.0;
  double too_wide_mm2 = 0.0, missing_mm2 = 0.0;
};
OutlineOutcome outlineOutcome(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanals& tooth);

struct LostTissue {
  double enamel_mm3 = 0.0, dentine_mm3 = 0.0;
  double floor_mm3 = 0.0;   ///< of it below the chamber's floor, beside the orifices
  double deepest_mm = 0.0;  ///< below the cusp; canals apart
};
/// Of these blocks.
LostTissue lostTissue(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanals& tooth,
                      std::span<const glm::ivec3> blocks);
LostTissue& operator+=(LostTissue& lost, const LostTissue& more);

/// Whether a change of a block may change what the functions above and straightLine() find.
bool isOverChamber(const assets::ToothCanals& tooth, const assets::VolumeGrid& grid, glm::ivec3 block);
bool isOverOrifice(const assets::ToothCanal& canal, const assets::VolumeGrid& grid, glm::ivec3 block);

/// A straight file, from the canal's third millimetre upwards along its axis there.
struct StraightLine {
  double blocked_mm3 = 0.0;      ///< of tooth over the orifice in the way of 0.57 mm, the shaft of a #25
  double least_angle_rad = 0.0;  ///< that a line from the orifice must lean to be free; pi / 2: none is
  bool isFree() const;           ///< less than 5 degrees
};
StraightLine straightLine(const FineSolid& after, const assets::ToothCanal& canal);

/// Lower molars: from the buccal cusp to the roof 6.36 +-0.93 mm, to the floor 7.95 +-0.79 (Deutsch and Musikant 2004,
/// JOE 30:388).
enum class DepthBand { fine, amber, red };
DepthBand depthBand(double below_cusp_mm);
/// Along the tooth, below the reference of its first canal.
double belowCusp_mm(const assets::ToothCanals& tooth, const glm::dvec3& p_P_mm);

}  // namespace app
