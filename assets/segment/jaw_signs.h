// What tells a lower jaw from other dense bone, whatever its scale of greys: its teeth stand in a row under the bite,
// each has a cap of enamel over its middle and bone under its root, and between the two halves lies the tongue, no
// bone. Shares of the pieces of a tooth's size. Frame P, mm. Pure; any thread but the servo; 5 ns a voxel.
#pragma once

#include <vector>

#include "assets/segment/bite_sheet.h"
#include "assets/segment/jaw_arch.h"
#include "assets/segment/mandible.h"
#include "assets/segment/tooth_numbers.h"

namespace assets {

struct JawSigns {
  int tooth_sized = 0;
  double capped = 0.0;     ///< the share with enamel, whose middle is a millimetre or more from their own
  double crowns_up = 0.0;  ///< of those, with enamel above
  double in_row = 0.0;     ///< the share near the arch, under the bite
  double over_bone = 0.0;  ///< the share with the jaw's bone below, of those under which the scan goes on
};

/// 90 to 2600 mm3, shorter than 32 mm.
bool hasToothSize(const FoundTooth& tooth);

JawSigns jawSigns(const Mandible& jaw, const JawArch& arch, const BiteSheet& sheet,
                  const std::vector<FoundTooth>& teeth);

/// How much of what lies within the arch, at the height of the teeth and their roots, is hard: 0 to 1. Of a scan of one
/// side 0: its middle is not in it.
double hardWithinArch(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch,
                      const BiteSheet& sheet);

}  // namespace assets
