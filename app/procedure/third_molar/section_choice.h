// Of several sections of a tooth the one after which it comes out most easily: each is tried on a copy, and what would
// be in the way of its pieces is added up (ways_out). Frame P, mm. Any thread; some seconds a section; allocates. The
// same bytes give the same sum.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/ways_out.h"
#include "assets/planned_cut.h"

namespace app {

/// What the tooth and the bone around it are like before the section.
struct UncutSite {
  const AroundTooth& around;
  const assets::VolumeGrid& piece_grid;
  std::span<const std::uint8_t> tooth_solid;  ///< in its order
  const WayUp& up;
};

/// mm³ in the way of all pieces, one after the other, once `cut` was made and the tooth has parted along `parting`: the
/// same section, or one through what `cut` spares, which breaks. What cannot come counts kNoWay_mm3. None: its
/// largest piece has `most_share` of the tooth's volume or more, it stays whole.
std::optional<double> inTheWayAfter_mm3(const UncutSite& site, const assets::PlannedCut& cut,
                                        const assets::PlannedCut& parting, double most_share);
inline constexpr double kNoWay_mm3 = 1000.0;

}  // namespace app
